#include "postprocess/render/actors.hpp"

#include "postprocess/render/view.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <fmt/format.h>

namespace tessera::post {
namespace {

vtkSmartPointer<vtkActor> splats(const std::vector<Point>& positions, const std::vector<Colour>& shades,
                                 const std::vector<float>& radii, const Optics& optics) {
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkUnsignedCharArray> colours;
  const vtkNew<vtkFloatArray> sizes;
  colours->SetName("colour");
  colours->SetNumberOfComponents(3);
  sizes->SetName("radius");
  points->SetNumberOfPoints(static_cast<vtkIdType>(positions.size()));
  colours->SetNumberOfTuples(static_cast<vtkIdType>(positions.size()));
  sizes->SetNumberOfTuples(static_cast<vtkIdType>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto p = static_cast<vtkIdType>(i);
    points->SetPoint(p, positions[i].data());
    colours->SetTypedTuple(p, shades[i].data());
    sizes->SetValue(p, radii[i]);
  }
  const vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->GetPointData()->SetScalars(colours);
  data->GetPointData()->AddArray(sizes);
  const vtkNew<vtkPointGaussianMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetScaleArray("radius");
  mapper->SetScaleFactor(1);
  mapper->SetTriangleScale(1.0f);
  mapper->EmissiveOff();
  // Each splat becomes a sphere: lit from the upper left, with its true depth so that neighbours meet in
  // arcs. How fast the offset changes from pixel to pixel tells the sphere's radius.
  mapper->SetSplatShaderCode(
      fmt::format(
          "//VTK::Color::Impl\n"
          "float radii_per_pixel = length(vec2(dFdx(offsetVCVSOutput.x), dFdy(offsetVCVSOutput.x)));\n"
          "float across2 = dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy);\n"
          "if (across2 > 1.0) discard;\n"
          "float height = sqrt(1.0 - across2);\n"
          "vec3 outwards = vec3(offsetVCVSOutput.xy, height);\n"
          "float light = max(0.0, dot(outwards, vec3(-0.30, 0.40, 0.866)));\n"
          "float shine = 0.16 * pow(light, 24.0);\n"
          "ambientColor = vec3(0.0);\n"
          "diffuseColor = (0.50 + 0.53 * light) * diffuseColor + vec3(shine);\n"
          "gl_FragDepth = gl_FragCoord.z - {:.9e} * height / radii_per_pixel;\n",
          optics.metres_per_pixel / optics.depth)
          .c_str());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  return actor;
}

/// Lines of one dark colour.
vtkSmartPointer<vtkActor> line_actor(vtkPolyData* data, double grey, float width) {
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(grey, grey, grey);
  actor->GetProperty()->SetLineWidth(width);
  return actor;
}

vtkSmartPointer<vtkPoints> points_of(const CellSurfaces& cells) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  for (const Vec3& x : cells.points)
    points->InsertNextPoint(x.data());
  return points;
}

} // namespace

vtkSmartPointer<vtkActor> spheres(const Body& body, const ColourScale& scale, const Optics& optics) {
  std::vector<Colour> colours;
  for (const double value : body.values)
    colours.push_back(scale(value));
  return splats(body.points, colours, body.radii, optics);
}

vtkSmartPointer<vtkActor> dots(const Body& body, double part, const Optics& optics) {
  std::vector<float> radii;
  for (const float radius : body.radii)
    radii.push_back(static_cast<float>(part) * radius);
  return splats(body.points, std::vector<Colour>(radii.size(), Colour{35, 35, 35}), radii, optics);
}

vtkSmartPointer<vtkActor> cell_faces(const CellSurfaces& cells, const std::vector<double>& values,
                                     const ColourScale& scale) {
  const vtkNew<vtkCellArray> polygons;
  const vtkNew<vtkUnsignedCharArray> colours;
  colours->SetNumberOfComponents(3);
  for (const CellSurfaces::Face& face : cells.faces) {
    polygons->InsertNextCell(static_cast<int>(face.loop.size()));
    for (const std::int32_t p : face.loop)
      polygons->InsertCellPoint(p);
    const Colour colour = scale(values[static_cast<std::size_t>(face.particle)]);
    colours->InsertNextTypedTuple(colour.data());
  }
  const vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(cells));
  data->SetPolys(polygons);
  data->GetCellData()->SetScalars(colours);
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  actor->GetProperty()->SetAmbient(0.70);
  actor->GetProperty()->SetDiffuse(0.33);
  actor->GetProperty()->SetSpecular(0);
  return actor;
}

vtkSmartPointer<vtkActor> cell_edges(const CellSurfaces& cells, const Point& towards_viewer, float width) {
  const vtkNew<vtkCellArray> lines;
  for (const auto& [a, b] : cells.edges) {
    const vtkIdType ends[2] = {a, b};
    lines->InsertNextCell(2, ends);
  }
  const vtkNew<vtkPolyData> data;
  data->SetPoints(points_of(cells));
  data->SetLines(lines);
  auto actor = line_actor(data, 0.15, width);
  actor->SetPosition(towards_viewer.x(), towards_viewer.y(), towards_viewer.z());
  return actor;
}

vtkSmartPointer<vtkActor> box_lines(const Eigen::AlignedBox3f& box) {
  const vtkNew<vtkPoints> points;
  for (const Point& p : corners(box))
    points->InsertNextPoint(p.data());
  const vtkNew<vtkCellArray> lines;
  for (vtkIdType a = 0; a < 8; ++a)
    for (const vtkIdType bit : {1, 2, 4}) {
      const vtkIdType ends[2] = {a, a | bit};
      if (ends[0] != ends[1])
        lines->InsertNextCell(2, ends);
    }
  const vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(lines);
  return line_actor(data, 0.55, 2);
}

} // namespace tessera::post

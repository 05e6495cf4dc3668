#include "postprocess/render/actors.hpp"

#include "postprocess/render/view.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointGaussianMapper.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

#include <fmt/format.h>

#include <array>
#include <limits>

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

vtkSmartPointer<vtkPoints> points_of(const std::vector<Vec3>& positions) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  for (const Vec3& x : positions)
    points->InsertNextPoint(x.data());
  return points;
}

/// Polygons whose colours are found between the points, not mixed from theirs.
vtkSmartPointer<vtkPolyData> polygons_of(const CutBody& body, const std::vector<CutBody::Polygon>& faces) {
  const vtkNew<vtkCellArray> polygons;
  for (const CutBody::Polygon& face : faces) {
    polygons->InsertNextCell(static_cast<int>(face.size()));
    for (const std::int32_t p : face)
      polygons->InsertCellPoint(p);
  }
  const vtkNew<vtkFloatArray> values;
  for (const double value : body.values)
    values->InsertNextValue(static_cast<float>(value));
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points_of(body.points));
  data->SetPolys(polygons);
  data->GetPointData()->SetScalars(values);
  return data;
}

vtkSmartPointer<vtkActor> coloured(vtkPolyDataMapper& mapper, const ColourScale& scale) {
  constexpr int shades = 512;
  const vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(shades);
  table->SetRange(scale.minimum, scale.maximum);
  const auto entry = [&](double value) {
    const Colour colour = scale(value);
    return std::array{colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0, 1.0};
  };
  for (int s = 0; s < shades; ++s)
    table->SetTableValue(s,
                         entry(scale.minimum + (s + 0.5) / shades * (scale.maximum - scale.minimum)).data());
  table->SetNanColor(entry(std::numeric_limits<double>::quiet_NaN()).data());
  mapper.SetLookupTable(table);
  mapper.UseLookupTableScalarRangeOn();
  mapper.InterpolateScalarsBeforeMappingOn();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(&mapper);
  return actor;
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
  data->SetPoints(points_of(cells.points));
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
  std::vector<std::array<Vec3, 2>> lines;
  for (const auto& [a, b] : cells.edges)
    lines.push_back({cells.points[a], cells.points[b]});
  return drawn_lines(lines, {0.15, width}, towards_viewer);
}

vtkSmartPointer<vtkActor> skin_faces(const CutBody& body, const ColourScale& scale) {
  const vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(polygons_of(body, body.skin));
  normals->SetFeatureAngle(35);
  normals->ConsistencyOff(); // they are
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  auto actor = coloured(*mapper, scale);
  actor->GetProperty()->SetInterpolationToPhong();
  // No highlights: they would pass for values.
  actor->GetProperty()->SetAmbient(0.72);
  actor->GetProperty()->SetDiffuse(0.30);
  actor->GetProperty()->SetSpecular(0);
  return actor;
}

vtkSmartPointer<vtkActor> flat_faces(const CutBody& body, const std::vector<CutBody::Polygon>& faces,
                                     const ColourScale& scale) {
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(polygons_of(body, faces));
  auto actor = coloured(*mapper, scale);
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkSmartPointer<vtkActor> grey_faces(const std::vector<std::array<Vec3, 4>>& faces, double grey) {
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkCellArray> cells;
  for (const auto& face : faces) {
    cells->InsertNextCell(4);
    for (const Vec3& x : face)
      cells->InsertCellPoint(points->InsertNextPoint(x.data()));
  }
  const vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(grey, grey, grey);
  return actor;
}

vtkSmartPointer<vtkActor> drawn_lines(const std::vector<std::array<Vec3, 2>>& lines, const Pen& pen,
                                      const Point& towards_viewer) {
  const vtkNew<vtkPoints> points;
  const vtkNew<vtkCellArray> cells;
  for (const auto& [a, b] : lines) {
    const vtkIdType ends[2] = {points->InsertNextPoint(a.data()), points->InsertNextPoint(b.data())};
    cells->InsertNextCell(2, ends);
  }
  const vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetLines(cells);
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(pen.grey, pen.grey, pen.grey);
  actor->GetProperty()->SetLineWidth(pen.width);
  actor->SetPosition(towards_viewer.x(), towards_viewer.y(), towards_viewer.z());
  return actor;
}

std::vector<std::array<Vec3, 2>> box_lines(const Eigen::AlignedBox3f& box) {
  const std::vector<Point> points = corners(box);
  std::vector<std::array<Vec3, 2>> lines;
  for (std::size_t a = 0; a < 8; ++a)
    for (const std::size_t bit : {1, 2, 4})
      if ((a & bit) == 0)
        lines.push_back({points[a].cast<double>(), points[a | bit].cast<double>()});
  return lines;
}

} // namespace tessera::post

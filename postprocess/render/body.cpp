#include "postprocess/render/body.hpp"

#include "core/error.hpp"
#include "core/neighbours.hpp"
#include "io/vtk_write.hpp"
#include "postprocess/quantity.hpp"

#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStaticPointLocator.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera::post {
namespace {

template <class Reader>
vtkSmartPointer<vtkPointSet> points_of(const std::string& file) {
  const vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutput();
}

vtkSmartPointer<vtkPointSet> read_points(const std::string& file) {
  io::require_complete(file);
  auto set = file.ends_with(".vtp") ? points_of<vtkXMLPolyDataReader>(file)
                                    : points_of<vtkXMLUnstructuredGridReader>(file);
  require(set && set->GetNumberOfPoints() > 0, "the file is damaged or holds no particles", file, "");
  return set;
}

/// Half the diagonal of a lattice cell's face: nothing shines through between the spheres.
constexpr double radius_over_spacing = 0.71;

/// Component of "xx" or "x" in a tuple; -1 where there is none.
int component_index(const std::string& name, int components) {
  const auto& names = component_names(components);
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

std::vector<double> values_of(vtkPointSet& set, const std::string& field, const std::string& file) {
  const auto dot = field.rfind('.');
  const std::string name = field.substr(0, dot);
  vtkPointData& arrays = *set.GetPointData();
  vtkDataArray* array = arrays.GetArray(name.c_str());
  if (!array) {
    std::vector<std::string> there;
    for (int i = 0; i < arrays.GetNumberOfArrays(); ++i)
      there.emplace_back(arrays.GetArrayName(i));
    throw InputError(fmt::format("no field '{}'", name), file,
                     fmt::format("it has: {}", fmt::join(there, ", ")));
  }
  const int components = array->GetNumberOfComponents();
  const int component = dot == std::string::npos ? (components == 1 ? 0 : -1)
                                                 : component_index(field.substr(dot + 1), components);
  const bool magnitude = dot == std::string::npos && components == 3;
  require(component >= 0 || magnitude, fmt::format("field '{}' is no single number", field), file,
          components == 1
              ? fmt::format("'{}' has no components", name)
              : fmt::format("name a component: {}.{}", name, fmt::join(component_names(components), ", .")));
  std::vector<double> values(static_cast<std::size_t>(set.GetNumberOfPoints()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto p = static_cast<vtkIdType>(i);
    if (!magnitude) {
      values[i] = array->GetComponent(p, component);
      continue;
    }
    Eigen::Vector3d v;
    array->GetTuple(p, v.data());
    values[i] = v.norm();
  }
  return values;
}

/// Of Triaxiality von Mises' stress and pressure together, of the LodeAngle the former; else none.
std::vector<double> stress_behind(vtkPointSet& set, const std::string& field, const std::string& file) {
  if (field != "Triaxiality" && field != "LodeAngle")
    return {};
  std::vector<double> stress = values_of(set, "VonMises", file);
  if (field == "Triaxiality") {
    const std::vector<double> pressure = values_of(set, "Pressure", file);
    for (std::size_t i = 0; i < stress.size(); ++i)
      stress[i] += std::abs(pressure[i]);
  }
  return stress;
}

/// Median over a sample of the mean distance to the nearest six (four in a plane): the spacing itself on a
/// lattice.
double typical_spacing(const std::vector<Point>& reference, bool plane) {
  const vtkNew<vtkPoints> points;
  for (const Point& p : reference)
    points->InsertNextPoint(p.data());
  const vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  const vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(data);
  locator->BuildLocator();
  const int neighbours = plane ? 4 : 6;
  const std::size_t stride = reference.size() / 500 + 1;
  std::vector<double> distances;
  const vtkNew<vtkIdList> nearest;
  for (std::size_t i = 0; i < reference.size(); i += stride) {
    const Eigen::Vector3d x = reference[i].cast<double>();
    locator->FindClosestNPoints(neighbours + 1, x.data(), nearest);
    double sum = 0;
    for (vtkIdType k = 0; k < nearest->GetNumberOfIds(); ++k)
      sum += (reference[static_cast<std::size_t>(nearest->GetId(k))] - reference[i]).norm();
    if (nearest->GetNumberOfIds() > 1)
      distances.push_back(sum / static_cast<double>(nearest->GetNumberOfIds() - 1));
  }
  if (distances.empty())
    return 0;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

} // namespace

Body read_body(const Panel& panel, const std::string& field) {
  const auto set = read_points(panel.file);
  Body body;
  body.values = values_of(*set, field, panel.file);
  body.stress = stress_behind(*set, field, panel.file);
  vtkDataArray* displacement = set->GetPointData()->GetArray("Displacement");
  std::vector<Point> reference;
  for (vtkIdType i = 0; i < set->GetNumberOfPoints(); ++i) {
    Eigen::Vector3d x, u = Eigen::Vector3d::Zero();
    set->GetPoint(i, x.data());
    if (displacement && displacement->GetNumberOfComponents() == 3)
      displacement->GetTuple(i, u.data());
    require(x.allFinite(), fmt::format("particle {} is nowhere", i), panel.file,
            "the run failed before this frame");
    reference.push_back((x - u).cast<float>());
    body.displacement.push_back(panel.magnify * u);
    body.points.push_back((x - u + body.displacement.back()).cast<float>());
    body.reference.extend(reference.back());
  }
  body.plane = body.reference.sizes().z() == 0;
  body.spacing = panel.spacing > 0 ? panel.spacing : typical_spacing(reference, body.plane);
  if (!(body.spacing > 0))
    body.spacing = std::max(1e-3, 0.1 * static_cast<double>(body.reference.sizes().maxCoeff()));
  body.radii.assign(body.points.size(), static_cast<float>(radius_over_spacing * body.spacing));
  return body;
}

void mask_unstressed(std::vector<Body>& bodies) {
  constexpr double share = 0.01;
  double largest = 0;
  for (const Body& body : bodies)
    for (const double stress : body.stress)
      largest = std::max(largest, stress);
  for (Body& body : bodies)
    for (std::size_t i = 0; i < body.stress.size(); ++i)
      if (!(body.stress[i] > share * largest))
        body.values[i] = std::numeric_limits<double>::quiet_NaN();
}

void touch(Body& body, double largest) {
  const int others = std::min(body.plane ? 3 : 4, static_cast<int>(body.points.size()) - 1);
  if (others < 1)
    return;
  std::vector<Vec3> X;
  for (const Point& p : body.points)
    X.push_back(p.cast<double>());
  const std::vector<double> distance = distance_to_nearest(X, others);
  for (std::size_t i = 0; i < distance.size(); ++i)
    body.radii[i] = static_cast<float>(std::min(0.5 * distance[i], largest));
}

CutPlane cut_plane(const Panel& panel, const Eigen::AlignedBox3f& box, const Point& direction) {
  const int axis = panel.clip == "x" ? 0 : panel.clip == "y" ? 1 : 2;
  const double middle = 0.5 * (double{box.min()[axis]} + double{box.max()[axis]});
  return {axis, std::isnan(panel.clip_at) ? middle : panel.clip_at, direction[axis] < -1e-6f ? -1.0 : 1.0};
}

std::vector<bool> keep_beyond(Body& body, const CutPlane& plane) {
  // A layer that lies on the plane stays, whichever way it was rounded.
  const double slack = 0.01 * body.spacing;
  std::vector<bool> stays(body.points.size(), false);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    if (plane.beyond(body.points[i].cast<double>()) < -slack)
      continue;
    stays[i] = true;
    body.points[kept] = body.points[i];
    body.radii[kept] = body.radii[i];
    body.values[kept++] = body.values[i];
  }
  require(kept > 0, fmt::format("nothing of the body lies beyond {} = {} m", "xyz"[plane.axis], plane.at), "",
          "cut it elsewhere, or leave clip_at out for its middle");
  body.points.resize(kept);
  body.radii.resize(kept);
  body.values.resize(kept);
  return stays;
}

Eigen::AlignedBox3f span_of(const Body& body) {
  Eigen::AlignedBox3f box;
  for (const Point& p : body.points)
    box.extend(p);
  return box;
}

} // namespace tessera::post

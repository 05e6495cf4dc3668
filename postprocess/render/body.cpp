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
#include <functional>

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
  vtkDataArray* displacement = set->GetPointData()->GetArray("Displacement");
  std::vector<Point> reference;
  for (vtkIdType i = 0; i < set->GetNumberOfPoints(); ++i) {
    Eigen::Vector3d x, u = Eigen::Vector3d::Zero();
    set->GetPoint(i, x.data());
    if (displacement && displacement->GetNumberOfComponents() == 3)
      displacement->GetTuple(i, u.data());
    require(x.allFinite(), fmt::format("particle {} is nowhere", i), panel.file,
            "the run failed before this frame");
    body.points.push_back(x.cast<float>());
    reference.push_back((x - u).cast<float>());
    body.reference.extend(reference.back());
  }
  body.plane = body.reference.sizes().z() == 0;
  body.spacing = panel.spacing > 0 ? panel.spacing : typical_spacing(reference, body.plane);
  if (!(body.spacing > 0))
    body.spacing = std::max(1e-3, 0.1 * static_cast<double>(body.reference.sizes().maxCoeff()));
  body.radii.assign(body.points.size(), static_cast<float>(radius_over_spacing * body.spacing));
  return body;
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

std::vector<bool> keep_far_half(Body& body, const std::string& axis, const Point& direction) {
  const int c = axis == "x" ? 0 : axis == "y" ? 1 : 2;
  const auto [low, high] = std::minmax_element(body.points.begin(), body.points.end(),
                                               [c](const Point& a, const Point& b) { return a[c] < b[c]; });
  const float middle = ((*low)[c] + (*high)[c]) / 2;
  const float side = direction[c] < -1e-6f ? -1.0f : 1.0f;
  // A layer that lies on the middle plane stays, whichever way it was rounded.
  const float slack = 0.01f * static_cast<float>(body.spacing);
  std::vector<bool> stays(body.points.size(), false);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    if (side * (body.points[i][c] - middle) < -slack)
      continue;
    stays[i] = true;
    body.points[kept] = body.points[i];
    body.radii[kept] = body.radii[i];
    body.values[kept++] = body.values[i];
  }
  body.points.resize(kept);
  body.radii.resize(kept);
  body.values.resize(kept);
  return stays;
}

} // namespace tessera::post

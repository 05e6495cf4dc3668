#include "postprocess/render/view.hpp"

#include "core/error.hpp"

#include <vtkCamera.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkRenderer.h>

#include <fmt/format.h>

namespace tessera::post {

View view_of(const std::string& name) {
  const Point x = Point::UnitX(), y = Point::UnitY(), z = Point::UnitZ();
  if (name == "back")
    return {-x, z, -y};
  if (name == "left")
    return {-y, z, x};
  if (name == "right")
    return {y, z, -x};
  if (name == "top")
    return {x, y, -z};
  if (name == "bottom")
    return {x, -y, z};
  if (name == "iso") {
    const Point into = Point(-0.75f, 1.0f, -0.6f).normalized();
    const Point right = into.cross(z).normalized();
    return {right, right.cross(into), into};
  }
  require(name == "front", fmt::format("no view is named '{}'", name), "",
          "front, back, left, right, top, bottom and iso are");
  return {x, z, y};
}

Eigen::AlignedBox3f extent(const View& view, const std::vector<Point>& points) {
  Eigen::AlignedBox3f box;
  for (const Point& p : points)
    box.extend(view.seen(p));
  return box;
}

std::vector<Point> corners(const Eigen::AlignedBox3f& box) {
  std::vector<Point> out;
  for (int c = 0; c < 8; ++c)
    out.push_back(box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(c)));
  return out;
}

double depth_of(const Eigen::AlignedBox3f& box) {
  return 1.1 * static_cast<double>(box.sizes().z());
}

void look_at(vtkRenderer& renderer, const View& view, const Eigen::AlignedBox3f& box, double height) {
  const double depth = depth_of(box);
  const Point middle = box.center();
  const Point focus = middle.x() * view.right + middle.y() * view.up + middle.z() * view.into;
  const Point eye = focus - static_cast<float>(depth) * view.into;
  vtkCamera& camera = *renderer.GetActiveCamera();
  camera.ParallelProjectionOn();
  camera.SetFocalPoint(focus.x(), focus.y(), focus.z());
  camera.SetPosition(eye.x(), eye.y(), eye.z());
  camera.SetViewUp(view.up.x(), view.up.y(), view.up.z());
  camera.SetParallelScale(height / 2);
  camera.SetClippingRange(0.5 * depth, 1.5 * depth);

  const vtkNew<vtkLight> light;
  light->SetLightTypeToCameraLight();
  light->SetPosition(-0.30, 0.40, 0.866);
  light->SetFocalPoint(0, 0, 0);
  renderer.AutomaticLightCreationOff();
  renderer.RemoveAllLights();
  renderer.AddLight(light);
}

} // namespace tessera::post

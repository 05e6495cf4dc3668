#include "postprocess/skin.hpp"

#include "core/parallel.hpp"
#include "postprocess/refine.hpp"
#include "postprocess/snapshot.hpp"

#include <algorithm>
#include <cmath>

namespace tessera::post {
namespace {

constexpr double most_sections = 40'000; ///< cubes of the tetrahedra's size in a body

template <class T>
std::vector<T> at_points(const Skin& skin, std::span<const T> values) {
  std::vector<T> out(skin.at.size());
  for_each(static_cast<std::int64_t>(out.size()), [&](std::int64_t i) {
    const auto p = static_cast<std::size_t>(i);
    out[p] = skin.at[p]([&](std::int32_t b) -> T { return values[static_cast<std::size_t>(b)]; });
  });
  return out;
}

} // namespace

Skin skin_of(const BodyMesh& mesh, const ParticleCloud& cloud, bool inside) {
  double longest = cloud.spacing;
  BodyMesh shown = mesh;
  if (inside)
    longest = std::max(longest, std::cbrt(cloud.domain_volume / most_sections));
  else
    shown.solids.clear();
  Skin skin{refined(shown, longest), {}};
  auto at = samplings(cloud, skin.mesh.points);
  for (std::size_t p = 0; p < at.size(); ++p) {
    if (!at[p]) {
      const auto nearest =
          std::min_element(cloud.X.begin(), cloud.X.end(), [&](const Vec3& a, const Vec3& b) {
            return (a - skin.mesh.points[p]).squaredNorm() < (b - skin.mesh.points[p]).squaredNorm();
          });
      at[p] = solver::Sampling{{static_cast<std::int32_t>(nearest - cloud.X.begin())}, {1}, 0};
    }
    skin.at.push_back(std::move(*at[p]));
  }
  return skin;
}

std::vector<Vec3> moved(const Skin& skin, std::span<const Vec3> displacement) {
  std::vector<Vec3> x = at_points(skin, displacement);
  for (std::size_t p = 0; p < x.size(); ++p)
    x[p] += skin.mesh.points[p];
  return x;
}

std::vector<double> values_on(const Skin& skin, std::span<const double> values) {
  return at_points(skin, values);
}

} // namespace tessera::post

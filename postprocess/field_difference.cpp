#include "postprocess/field_difference.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace tessera::post {
namespace {

constexpr std::size_t most_points = 4000;

/// All particles, or some of them by steps of the golden section, which does not fall in step with the rows
/// of a lattice.
std::vector<std::size_t> chosen_particles(std::size_t particles) {
  std::vector<std::size_t> chosen(std::min(particles, most_points));
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  if (particles <= most_points)
    return chosen;
  for (std::size_t& k : chosen) {
    const double turn = static_cast<double>(k) * std::numbers::phi;
    k = static_cast<std::size_t>((turn - std::floor(turn)) * static_cast<double>(particles));
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  return chosen;
}

} // namespace

std::vector<Difference> differences_from_first(const std::vector<Snapshot>& runs,
                                               const std::vector<std::string>& fields) {
  const ParticleCloud& cloud = runs.front().cloud;
  const std::vector<std::size_t> chosen = chosen_particles(cloud.X.size());
  std::vector<Vec3> points;
  for (const std::size_t a : chosen)
    points.push_back(cloud.X[a]);
  const auto first = samplings(runs.front(), points, Configuration::reference);

  std::vector<Difference> out;
  for (const Snapshot& run : runs) {
    const auto here = &run == &runs.front() ? first : samplings(run, points, Configuration::reference);
    Difference& difference = out.emplace_back();
    for (std::size_t i = 0; i < points.size(); ++i)
      difference.points += first[i] && here[i];
    for (const std::string& name : fields) {
      const io::StoredField f_1 = field_of(runs.front(), name), f = field_of(run, name);
      FieldDifference& field = difference.fields.emplace_back(FieldDifference{name, std::nullopt, 0});
      double apart = 0, size = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (!first[i] || !here[i])
          continue;
        const Eigen::VectorXd value = value_at(f_1, *first[i]);
        const double distance = (value_at(f, *here[i]) - value).norm();
        apart += cloud.V[chosen[i]] * distance * distance;
        size += cloud.V[chosen[i]] * value.squaredNorm();
        field.largest = std::max(field.largest, distance);
      }
      if (size > 0)
        field.relative = std::sqrt(apart / size);
    }
  }
  return out;
}

} // namespace tessera::post

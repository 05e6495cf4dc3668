#include "core/particle_cloud.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tessera {
namespace {

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

} // namespace

std::string nearest_name(const std::string& word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 2);
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance || (distance == best_distance && best.empty())) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

const ParticleSet& ParticleCloud::set(const std::string& name, const std::string& where) const {
  for (const ParticleSet& s : sets)
    if (s.name == name)
      return s;
  std::vector<std::string> names;
  for (const ParticleSet& s : sets)
    names.push_back(s.name);
  const std::string nearest = nearest_name(name, names);
  throw InputError(fmt::format("no particle set is named '{}'", name), where,
                   fmt::format("{}the cloud has: {}",
                               nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest),
                               names.empty() ? "no sets" : fmt::format("{}", fmt::join(names, ", "))));
}

void ParticleCloud::validate(const std::string& origin) const {
  const auto n = X.size();
  require(dimension == 2 || dimension == 3, fmt::format("dimension {} is neither 2 nor 3", dimension), origin,
          "");
  require(n > 0, "the cloud has no particles", origin, "ask for a smaller spacing or a larger count");
  require(V.size() == n && A.size() == n && centroid.size() == n && cad_dimension.size() == n,
          "the cloud's arrays differ in length", origin, "prepare it again");
  for (std::size_t i = 0; i < n; ++i) {
    require(X[i].allFinite() && A[i].allFinite() && centroid[i].allFinite() && std::isfinite(V[i]),
            fmt::format("particle {} has a value that is not finite", i), origin, "prepare the cloud again");
    require(V[i] > 0, fmt::format("particle {} has subvolume {:g}", i, V[i]), origin,
            "subvolumes must be positive: prepare the cloud again");
  }
  for (const ParticleSet& s : sets) {
    require(s.area.empty() || s.area.size() == s.particles.size(),
            fmt::format("set '{}' has {} particles but {} area vectors", s.name, s.particles.size(),
                        s.area.size()),
            origin, "prepare the cloud again");
    for (std::int32_t i : s.particles)
      require(i >= 0 && static_cast<std::size_t>(i) < n, fmt::format("set '{}' names particle {}", s.name, i),
              origin, "prepare the cloud again");
  }
  require(sight.empty() || sight.size() == n, "the cloud's arrays differ in length", origin,
          "prepare it again");
}

} // namespace tessera

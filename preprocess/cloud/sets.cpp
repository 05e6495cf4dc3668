#include "preprocess/cloud/sets.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace tessera::preprocess {
namespace {

bool contains(const std::vector<std::int32_t>& list, std::int32_t value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

std::int32_t nearest(const ParticleCloud& cloud, const Vec3& point) {
  std::int32_t best = 0;
  for (std::int32_t i = 1; i < cloud.size(); ++i)
    if ((cloud.X[i] - point).squaredNorm() < (cloud.X[best] - point).squaredNorm())
      best = i;
  return best;
}

ParticleSet set_of(const std::string& name, const std::set<std::int32_t>& particles) {
  return {name, {particles.begin(), particles.end()}, {}};
}

/// The set's particles' shares of the surfaces.
void give_areas(const SetSource& source, const std::vector<std::int32_t>& surfaces, ParticleSet& set) {
  set.area.assign(set.particles.size(), Vec3::Zero());
  for (std::size_t k = 0; k < set.particles.size(); ++k)
    for (const SurfaceShare& share : source.shares[set.particles[k]])
      if (contains(surfaces, share.surface))
        set.area[k] += share.area;
}

ParticleSet surface_set(const SetSource& source, const std::string& name,
                        const std::vector<std::int32_t>& surfaces) {
  std::set<std::int32_t> members;
  for (const std::int32_t surface : surfaces)
    members.insert(source.members[surface].begin(), source.members[surface].end());
  ParticleSet set = set_of(name, members);
  if (!set.particles.empty())
    give_areas(source, surfaces, set);
  return set;
}

/// Particles on the curves, or where none is (a lattice beside them) those nearest to points along them.
ParticleSet curve_set(const SetSource& source, const std::string& name,
                      const std::vector<std::int32_t>& curves) {
  std::set<std::int32_t> members;
  for (const std::int32_t curve : curves) {
    const std::size_t before = members.size();
    for (std::int32_t i = 0; i < source.cloud.size(); ++i)
      if (source.cad.on_curve(source.place[i], curve))
        members.insert(i);
    if (members.size() > before)
      continue;
    for (const auto& edge : source.domain.feature_edges) {
      if (edge.curve != curve)
        continue;
      const Vec3 &a = source.domain.vertices[edge.vertices[0]], &b = source.domain.vertices[edge.vertices[1]];
      const int steps = std::max(1, static_cast<int>(std::ceil(2 * (b - a).norm() / source.cloud.spacing)));
      for (int k = 0; k <= steps; ++k)
        members.insert(nearest(source.cloud, a + (b - a) * k / steps));
    }
  }
  return set_of(name, members);
}

/// The surfaces all of whose facets lie in the plane.
std::vector<std::int32_t> surfaces_in(const SetSource& source, const Vec3& point, const Vec3& unit,
                                      double tolerance) {
  std::vector<bool> inside(source.domain.surfaces.size(), true);
  for (const auto& facet : source.domain.facets) {
    if (facet.surface == Domain::lid)
      continue;
    for (const std::int32_t v : facet.vertices)
      if (std::abs(unit.dot(source.domain.vertices[v] - point)) > tolerance)
        inside[facet.surface] = false;
  }
  std::vector<std::int32_t> surfaces;
  for (std::size_t s = 0; s < inside.size(); ++s)
    if (inside[s])
      surfaces.push_back(static_cast<std::int32_t>(s));
  return surfaces;
}

} // namespace

namespace {

/// A name no set carries yet: groups of different dimension may share one, and "all" means every particle.
std::string free_name(const std::string& wanted, int dimension, const std::vector<ParticleSet>& taken) {
  constexpr const char* kind[] = {".points", ".curves", ".surfaces", ".volumes"};
  const auto is_taken = [&](const std::string& name) {
    return name == "all" ||
           std::any_of(taken.begin(), taken.end(), [&](const auto& set) { return set.name == name; });
  };
  std::string name = is_taken(wanted) ? wanted + kind[dimension] : wanted;
  while (is_taken(name))
    name += '_';
  return name;
}

} // namespace

std::vector<ParticleSet> group_sets(const SetSource& source) {
  std::vector<ParticleSet> sets;
  bool surfaces_named = false;
  for (const auto& group : source.domain.groups) {
    const std::string name = free_name(group.name, group.dimension, sets);
    switch (group.dimension) {
    case 0: {
      std::set<std::int32_t> members;
      for (const std::int32_t v : group.vertices)
        members.insert(nearest(source.cloud, source.domain.vertices[v]));
      sets.push_back(set_of(name, members));
      break;
    }
    case 1:
      sets.push_back(curve_set(source, name, group.curves));
      break;
    case 2:
      sets.push_back(surface_set(source, name, group.surfaces));
      surfaces_named = true;
      break;
    default: {
      ParticleSet all{name, {}, {}};
      for (std::int32_t i = 0; i < source.cloud.size(); ++i)
        all.particles.push_back(i);
      sets.push_back(std::move(all));
    }
    }
  }
  if (!surfaces_named) {
    std::map<std::string, std::vector<std::int32_t>> by_name;
    for (std::size_t s = 0; s < source.domain.surfaces.size(); ++s)
      by_name[source.domain.surfaces[s]].push_back(static_cast<std::int32_t>(s));
    for (const auto& [name, surfaces] : by_name)
      if (std::none_of(sets.begin(), sets.end(), [&](const auto& set) { return set.name == name; }))
        sets.push_back(surface_set(source, name, surfaces));
  }
  return sets;
}

ParticleSet selected_set(const SetSource& source, const SetSelector& selector) {
  const ParticleCloud& cloud = source.cloud;
  const std::string where = fmt::format("set \"{}\"", selector.name);
  const double tolerance = selector.tolerance > 0 ? selector.tolerance : 1e-3 * cloud.spacing;
  ParticleSet set{selector.name, {}, {}};
  std::vector<std::int32_t> surfaces;
  if (const auto* plane = std::get_if<PlaneSelector>(&selector.where)) {
    require(plane->normal.allFinite() && plane->normal.norm() > 0, "the plane's normal is zero", where,
            "give a direction");
    const Vec3 unit = plane->normal.normalized();
    for (std::int32_t i = 0; i < cloud.size(); ++i)
      if (std::abs(unit.dot(cloud.X[i] - plane->point)) <= tolerance)
        set.particles.push_back(i);
    surfaces = surfaces_in(source, plane->point, unit, tolerance);
    // A lattice may pass by the surface that lies in the plane: whoever owns some of it is meant too.
    std::set<std::int32_t> members(set.particles.begin(), set.particles.end());
    for (const std::int32_t surface : surfaces)
      members.insert(source.members[surface].begin(), source.members[surface].end());
    set.particles.assign(members.begin(), members.end());
  } else if (const auto* box = std::get_if<BoxSelector>(&selector.where)) {
    for (std::int32_t i = 0; i < cloud.size(); ++i)
      if (((cloud.X[i] - box->lower).array() >= -tolerance).all() &&
          ((box->upper - cloud.X[i]).array() >= -tolerance).all())
        set.particles.push_back(i);
  } else {
    const Vec3& point = std::get<NearestSelector>(selector.where).point;
    const Vec3 lower = source.domain.lower, upper = source.domain.upper;
    const double beyond = (lower - point).cwiseMax(point - upper).cwiseMax(0.0).norm();
    require(beyond <= (upper - lower).norm(),
            fmt::format("the point ({:g}, {:g}, {:g}) m lies {:.3g} m outside the body's bounding box",
                        point[0], point[1], point[2], beyond),
            where, "sets are in metres, whatever the unit of the file: move the point to the body");
    set.particles.push_back(nearest(cloud, point));
  }
  if (set.particles.empty()) {
    Vec3 lower = cloud.X[0], upper = cloud.X[0];
    for (const Vec3& X : cloud.X) {
      lower = lower.cwiseMin(X);
      upper = upper.cwiseMax(X);
    }
    throw InputError(
        "no particle is selected", where,
        fmt::format("move the selector or widen its tolerance of {:.3g} m: the particles lie between "
                    "({:.6g}, {:.6g}, {:.6g}) and ({:.6g}, {:.6g}, {:.6g}) m",
                    tolerance, lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]));
  }
  if (std::holds_alternative<PlaneSelector>(selector.where)) {
    if (!surfaces.empty())
      give_areas(source, surfaces, set);
  } else {
    bool any = false;
    for (const std::int32_t i : set.particles) {
      set.area.push_back(cloud.A[i]);
      any |= cloud.A[i].squaredNorm() > 0;
    }
    if (!any)
      set.area.clear();
  }
  return set;
}

} // namespace tessera::preprocess

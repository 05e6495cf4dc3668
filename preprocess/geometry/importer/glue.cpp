#include "preprocess/geometry/importer/glue.hpp"

#include "preprocess/geometry/importer/gmsh_session.hpp"

#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <string>

namespace tessera::importer {
namespace {

constexpr double same_place = 1e-6; // a few of OpenCASCADE's own tolerances

struct Physical {
  int dimension, tag;
  std::string name;
  std::vector<int> entities;
};

std::vector<Physical> physical_groups() {
  std::vector<Physical> groups;
  gmsh::vectorpair found;
  gmsh::model::getPhysicalGroups(found);
  for (const auto& [dimension, tag] : found) {
    Physical group{dimension, tag, {}, {}};
    gmsh::model::getPhysicalName(dimension, tag, group.name);
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, group.entities);
    groups.push_back(std::move(group));
  }
  return groups;
}

/// What tells an entity from its neighbours: its centre, and its length or area.
using Place = std::array<double, 4>;

std::map<std::pair<int, int>, Place> places() {
  std::map<std::pair<int, int>, Place> found;
  for (const int dimension : {2, 1, 0}) {
    gmsh::vectorpair entities;
    gmsh::model::occ::getEntities(entities, dimension);
    for (const auto& entity : entities) {
      Place& at = found[entity];
      if (dimension == 0) {
        double low[3];
        gmsh::model::occ::getBoundingBox(0, entity.second, low[0], low[1], low[2], at[0], at[1], at[2]);
        continue;
      }
      gmsh::model::occ::getCenterOfMass(dimension, entity.second, at[0], at[1], at[2]);
      gmsh::model::occ::getMass(dimension, entity.second, at[3]);
    }
  }
  return found;
}

void glue_by_opencascade() {
  const auto groups = physical_groups();
  const auto old_places = places();
  gmsh::vectorpair before, after;
  for (const auto& place : old_places)
    before.push_back(place.first);
  std::vector<gmsh::vectorpair> became;
  gmsh::model::occ::fragment(before, {}, after, became);
  gmsh::model::occ::synchronize();
  gmsh::model::removePhysicalGroups();
  // The map says what became of the entities that were cut, and gmsh 4.8 leaves out some that were not: those
  // are where they were.
  const auto new_places = places();
  std::map<std::pair<int, int>, gmsh::vectorpair> map;
  for (std::size_t i = 0; i < before.size() && i < became.size(); ++i) {
    auto& now = map[before[i]] = became[i];
    if (!now.empty())
      continue;
    const Place& at = old_places.at(before[i]);
    for (const auto& [entity, place] : new_places) {
      double apart = 0;
      for (int c = 0; c < 4; ++c)
        apart = std::max(apart, std::abs(place[c] - at[c]));
      if (entity.first == before[i].first && apart < same_place)
        now.push_back(entity);
    }
  }
  for (const Physical& group : groups) {
    std::set<int> entities;
    for (const int entity : group.entities)
      for (const auto& [dimension, tag] : map[{group.dimension, std::abs(entity)}])
        if (dimension == group.dimension)
          entities.insert(tag);
    if (entities.empty())
      continue;
    gmsh::model::addPhysicalGroup(group.dimension, {entities.begin(), entities.end()}, group.tag);
    if (!group.name.empty())
      gmsh::model::setPhysicalName(group.dimension, group.tag, group.name);
  }
}

} // namespace

std::vector<std::vector<int>> connected_surfaces() {
  const auto surfaces = tags_of(2);
  std::map<int, std::vector<int>> along; // surfaces along each curve
  std::map<int, int> first;              // smallest known tag of each surface's set
  for (const int surface : surfaces) {
    gmsh::vectorpair curves;
    gmsh::model::getBoundary({{2, surface}}, curves, false, false);
    for (const auto& curve : curves)
      along[std::abs(curve.second)].push_back(surface);
    first[surface] = surface;
  }
  const auto root = [&](int s) {
    while (first[s] != s)
      s = first[s];
    return s;
  };
  for (const auto& [curve, sharing] : along)
    for (const int surface : sharing) {
      const int a = root(surface), b = root(sharing.front());
      first[std::max(a, b)] = std::min(a, b);
    }
  std::map<int, std::vector<int>> sets;
  for (const int surface : surfaces)
    sets[root(surface)].push_back(surface);
  std::vector<std::vector<int>> found;
  for (auto& [tag, set] : sets)
    found.push_back(std::move(set));
  return found;
}

void glue_surfaces() {
  gmsh::vectorpair drawn;
  gmsh::model::occ::getEntities(drawn, 2);
  if (drawn.size() == tags_of(2).size()) {
    glue_by_opencascade();
  } else if (drawn.empty()) {
    gmsh::model::geo::removeAllDuplicates();
    gmsh::model::geo::synchronize();
  }
}

} // namespace tessera::importer

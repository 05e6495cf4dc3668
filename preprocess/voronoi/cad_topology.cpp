#include "preprocess/voronoi/cad_topology.hpp"

#include <algorithm>

namespace tessera::preprocess {
namespace {

bool contains(const std::vector<std::int32_t>& sorted, std::int32_t value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

void sort_unique(std::vector<std::vector<std::int32_t>>& lists) {
  for (auto& list : lists) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

struct Side {
  std::array<std::int32_t, 2> edge; ///< ascending
  std::int32_t curve;               ///< of a feature edge; -1: side `k` of facet `facet`
  std::int32_t facet, k;
};

} // namespace

CadTopology::CadTopology(const Domain& domain) {
  std::int32_t curves = 0;
  for (const auto& edge : domain.feature_edges)
    curves = std::max(curves, edge.curve + 1);
  const bool plane = domain.dimension == 2;
  if (plane)
    curves = std::max(curves, static_cast<std::int32_t>(domain.surfaces.size()));
  curve_surfaces_.resize(curves);
  curve_corners_.resize(curves);
  corner_surfaces_.resize(domain.corners.size());
  surface_neighbours_.resize(domain.surfaces.size());
  surface_itself_.resize(domain.surfaces.size());
  for (std::size_t s = 0; s < domain.surfaces.size(); ++s)
    surface_itself_[s].push_back(static_cast<std::int32_t>(s));
  corner_.assign(domain.vertices.size(), -1);
  for (std::size_t c = 0; c < domain.corners.size(); ++c)
    corner_[domain.corners[c]] = static_cast<std::int32_t>(c);
  curves_around_.assign(domain.facets.size(), {-1, -1, -1});
  smooth_across_.assign(domain.facets.size(), {-1, -1, -1});

  std::vector<Side> sides;
  sides.reserve(3 * domain.facets.size() + domain.feature_edges.size());
  for (const auto& edge : domain.feature_edges) {
    const auto [a, b] = std::minmax(edge.vertices[0], edge.vertices[1]);
    sides.push_back({{a, b}, edge.curve, -1, 0});
    for (const std::int32_t v : edge.vertices)
      if (is_corner(v))
        curve_corners_[edge.curve].push_back(v);
  }
  for (std::int32_t f = 0; f < static_cast<std::int32_t>(domain.facets.size()); ++f) {
    const auto& facet = domain.facets[f];
    for (std::int32_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(facet.vertices[k], facet.vertices[(k + 1) % 3]);
      sides.push_back({{a, b}, -1, f, k});
      if (is_corner(facet.vertices[k]) && facet.surface != Domain::lid)
        corner_surfaces_[corner_[facet.vertices[k]]].push_back(facet.surface);
    }
  }
  std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.curve > b.curve;
  });
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].edge == sides[begin].edge)
      ++end;
    const std::int32_t curve = sides[begin].curve;
    for (std::size_t s = begin; s < end; ++s) {
      if (sides[s].facet < 0)
        continue;
      const std::int32_t surface = domain.facets[sides[s].facet].surface;
      curves_around_[sides[s].facet][sides[s].k] = curve;
      if (curve >= 0 && surface != Domain::lid)
        curve_surfaces_[curve].push_back(surface);
    }
    // Between the walls of a slab, and between a wall and the lower lid, there is no feature edge.
    const auto runs_on = [&] {
      return !plane ||
             domain.facets[sides[begin].facet].surface == domain.facets[sides[begin + 1].facet].surface;
    };
    if (curve < 0 && end == begin + 2 && runs_on()) {
      smooth_across_[sides[begin].facet][sides[begin].k] = sides[begin + 1].facet;
      smooth_across_[sides[begin + 1].facet][sides[begin + 1].k] = sides[begin].facet;
    }
  }
  sort_unique(curve_surfaces_);
  sort_unique(curve_corners_);
  sort_unique(corner_surfaces_);
  for (const auto& around : plane ? corner_surfaces_ : curve_surfaces_)
    for (const std::int32_t a : around)
      for (const std::int32_t b : around)
        if (a != b)
          surface_neighbours_[a].push_back(b);
  sort_unique(surface_neighbours_);
}

const std::vector<std::int32_t>& CadTopology::surfaces_of(const CadPlace& place) const {
  static const std::vector<std::int32_t> none;
  switch (place.dimension) {
  case 0:
    return corner_surfaces_[corner_[place.entity]];
  case 1:
    return curve_surfaces_[place.entity];
  case 2:
    return place.entity < 0 ? none : surface_itself_[place.entity];
  default:
    return none;
  }
}

bool CadTopology::on_surface(const CadPlace& place, std::int32_t surface) const {
  return contains(surfaces_of(place), surface);
}

bool CadTopology::on_curve(const CadPlace& place, std::int32_t curve) const {
  return place.dimension == 1 ? place.entity == curve
                              : place.dimension == 0 && curve_ends_at(curve, place.entity);
}

bool CadTopology::curve_ends_at(std::int32_t curve, std::int32_t corner) const {
  return contains(curve_corners_[curve], corner);
}

bool CadTopology::curves_share_a_corner(std::int32_t a, std::int32_t b) const {
  return std::any_of(curve_corners_[a].begin(), curve_corners_[a].end(),
                     [&](std::int32_t corner) { return curve_ends_at(b, corner); });
}

bool CadTopology::surfaces_share_a_curve(std::int32_t a, std::int32_t b) const {
  return contains(surface_neighbours_[a], b);
}

} // namespace tessera::preprocess

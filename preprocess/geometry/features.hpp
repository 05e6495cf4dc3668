/// Feature edges, curves and corners of a boundary whose facets know their surfaces.
///
/// An edge of the boundary is a feature where its two facets lie on different surfaces: a seam, where one
/// smooth surface meets itself, is not, while the line between two surfaces that meet tangentially is (the
/// CAD says so). A corner is a vertex where one feature edge ends, or three or more meet, or two meet with a
/// kink, so that the one vertex which starts and ends a rim is none. A point that lies on no feature edge is
/// a corner where the facets around it are far from one plane (the tip of a cone).
///
/// In a slab (dimension 2) the feature edges are the upper rim. What was a line between two tangential
/// surfaces is a point between two curves there, so a vertex of the rim where two different curves meet is a
/// corner too, kink or none.
#pragma once

#include "preprocess/geometry/domain.hpp"

#include <functional>
#include <optional>

namespace tessera::preprocess {

/// For bodies that come without surfaces: facets joined by edges of less than `degrees` between their normals
/// become one surface. Sets Facet::surface and names the surfaces face1, face2, ... by first appearance.
void surfaces_by_angle(Domain& domain, double degrees);

/// Sets feature_edges, with curve = -1: where surfaces differ, and where normals differ by more than
/// `degrees`.
void find_feature_edges(Domain& domain, double degrees = 180);

/// What find_corners() needs to know of the vertices.
struct CornerRule {
  /// May this vertex be a corner at all? All may when empty.
  std::function<bool(std::int32_t vertex)> candidate;
  /// Kink between the two feature edges at a vertex in degrees, 0 for straight on; the angle between the
  /// edges themselves when empty.
  std::function<std::optional<double>(std::int32_t vertex)> kink;
  double largest_kink = 40; ///< degrees, more is a corner
  double largest_tilt =
      20; ///< degrees between a facet and the mean of those around a candidate off all features
};

/// Sets corners, in the order of the vertices.
void find_corners(Domain& domain, const CornerRule& rule);

/// Gives the feature edges without a curve one: chains from corner to corner (or closed) between the same two
/// surfaces. Numbering continues after the largest curve already there.
void chain_curves(Domain& domain);

} // namespace tessera::preprocess

#include "preprocess/geometry/features.hpp"
#include "preprocess/geometry/triangles.hpp"
#include "tests/support/domains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace tessera::preprocess {
namespace {

using std::numbers::pi;

/// Surfaces of a prism over a regular polygon: foot 0, top 1, mantle 2. Facets only.
Domain prism(int sides) {
  Domain domain;
  for (int i = 0; i < sides; ++i)
    for (const double z : {0.0, 1.0})
      domain.vertices.emplace_back(std::cos(2 * pi * i / sides), std::sin(2 * pi * i / sides), z);
  domain.vertices.emplace_back(0, 0, 0);
  domain.vertices.emplace_back(0, 0, 1);
  for (std::int32_t i = 0; i < sides; ++i) {
    const std::int32_t a = 2 * i, b = 2 * ((i + 1) % sides), c = 2 * sides;
    domain.facets.push_back({{b, a, c}, 0, -1});
    domain.facets.push_back({{a + 1, b + 1, c + 1}, 1, -1});
    domain.facets.push_back({{a, b, b + 1}, 2, -1});
    domain.facets.push_back({{a, b + 1, a + 1}, 2, -1});
  }
  domain.surfaces = {"foot", "top", "mantle"};
  return domain;
}

std::size_t curves(const Domain& domain) {
  std::set<std::int32_t> found;
  for (const auto& edge : domain.feature_edges)
    found.insert(edge.curve);
  return found.size();
}

TEST(Features, rims_of_a_cylinder_are_two_closed_curves_without_corners) {
  Domain domain = prism(24);
  find_feature_edges(domain);
  find_corners(domain, {});
  chain_curves(domain);
  EXPECT_EQ(domain.feature_edges.size(), 48u);
  EXPECT_EQ(curves(domain), 2u);
  EXPECT_TRUE(domain.corners.empty());
}

TEST(Features, angles_find_the_faces_of_a_prism_and_not_of_a_cylinder) {
  Domain six = prism(6);
  surfaces_by_angle(six, 40);
  find_feature_edges(six, 40);
  find_corners(six, {});
  chain_curves(six);
  EXPECT_EQ(six.surfaces.size(), 8u);
  EXPECT_EQ(six.corners.size(), 12u);
  EXPECT_EQ(curves(six), 18u);

  Domain round = prism(24);
  surfaces_by_angle(round, 40);
  EXPECT_EQ(round.surfaces.size(), 3u);
}

TEST(Features, a_kink_between_two_edges_is_a_corner_only_if_it_is_sharp_enough) {
  Domain domain = prism(6); // 60 degrees at each vertex of the rims, with the mantle one surface
  find_feature_edges(domain);
  find_corners(domain, {.candidate = {}, .kink = {}, .largest_kink = 61});
  EXPECT_TRUE(domain.corners.empty());
  find_corners(domain, {.candidate = {}, .kink = {}, .largest_kink = 59});
  EXPECT_EQ(domain.corners.size(), 12u);
  chain_curves(domain);
  EXPECT_EQ(curves(domain), 12u);
  // A CAD that knows the curve to be smooth there overrules the mesh.
  find_corners(domain, {.candidate = {}, .kink = [](std::int32_t) { return 0.0; }});
  EXPECT_TRUE(domain.corners.empty());
}

TEST(Features, the_tip_of_a_cone_is_a_corner_and_the_pole_of_a_flat_cap_is_not) {
  for (const double height : {1.0, 0.1}) {
    Domain domain = prism(24);
    domain.vertices.back()[2] += height;
    const auto tip = static_cast<std::int32_t>(domain.vertices.size()) - 1;
    find_feature_edges(domain);
    find_corners(domain, {.candidate = [&](std::int32_t v) { return v == tip; }, .kink = {}});
    EXPECT_EQ(domain.corners.size(), height > 0.5 ? 1u : 0u);
  }
}

TEST(Triangles, shells_are_oriented_counted_and_measured) {
  const Domain box = test::box_domain(Vec3(1, 1, 1), Vec3(2, 3, 4), 2);
  Triangles surface{box.vertices, {}};
  for (const auto& facet : box.facets)
    surface.triangles.push_back(facet.vertices);
  EXPECT_TRUE(unpaired_edges(surface.triangles).empty());
  for (std::size_t t = 1; t < surface.triangles.size(); t += 2)
    std::swap(surface.triangles[t][0], surface.triangles[t][2]);
  ASSERT_TRUE(orient(surface.triangles));
  const auto shells = shells_of(surface.triangles);
  EXPECT_EQ(std::set<std::int32_t>(shells.begin(), shells.end()).size(), 1u);
  const auto volumes = shell_volumes(surface.vertices, surface.triangles, shells);
  EXPECT_NEAR(std::abs(volumes.at(0)), 6, 1e-12);
  surface.triangles.pop_back();
  EXPECT_EQ(unpaired_edges(surface.triangles).size(), 3u);
}

TEST(Triangles, a_one_sided_band_cannot_be_oriented) {
  std::vector<Triangle> band;
  const int n = 6;
  for (std::int32_t i = 0; i < n; ++i) {
    std::int32_t a = 2 * i, b = 2 * i + 1, c = 2 * ((i + 1) % n), d = c + 1;
    if (i + 1 == n)
      std::swap(c, d); // the twist
    band.push_back({a, c, b});
    band.push_back({b, c, d});
  }
  EXPECT_FALSE(orient(band));
}

} // namespace
} // namespace tessera::preprocess

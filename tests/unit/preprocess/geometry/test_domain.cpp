#include "core/error.hpp"
#include "preprocess/geometry/boundary.hpp"
#include "preprocess/geometry/domain.hpp"
#include "tests/support/domains.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace tessera::preprocess {
namespace {

using test::box_domain;
using test::l_domain;

Domain one_tet() {
  Domain domain;
  domain.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  domain.tets = {{0, 1, 2, 3}};
  domain.facets = boundary_of(domain.tets);
  for (auto& facet : domain.facets)
    facet.surface = 0;
  domain.surfaces = {"skin"};
  domain.measure();
  return domain;
}

/// What validate() says, or nothing when it is content.
std::string complaint(const Domain& domain) {
  try {
    domain.validate("part.step");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Domain, measures_one_tetrahedron) {
  const Domain domain = one_tet();
  EXPECT_DOUBLE_EQ(domain.tet_volume(0), 1.0 / 6);
  EXPECT_DOUBLE_EQ(domain.volume, 1.0 / 6);
  EXPECT_EQ(domain.lower, Vec3(0, 0, 0));
  EXPECT_EQ(domain.upper, Vec3(1, 1, 1));
  EXPECT_EQ(complaint(domain), "");
}

TEST(Domain, measures_to_the_last_digits_far_from_the_origin_and_at_any_scale) {
  for (const double scale : {1e-6, 1e-3, 1.0, 1e3}) {
    const Domain domain = box_domain(Vec3::Zero(), scale * Vec3(1, 2, 3), 12);
    EXPECT_NEAR(domain.volume / (6 * scale * scale * scale), 1, 1e-14) << scale;
    EXPECT_EQ(complaint(domain), "") << scale;
  }
}

TEST(Domain, empty_measures_zero) {
  Domain domain;
  domain.measure();
  EXPECT_EQ(domain.volume, 0);
  EXPECT_NE(complaint(domain).find("no volume"), std::string::npos);
}

TEST(Boundary, faces_of_tetrahedra_point_outwards_and_name_their_tetrahedron) {
  const Domain domain = l_domain(3);
  for (const auto& facet : domain.facets) {
    const auto& [a, b, c] = facet.vertices;
    const Vec3 normal =
        (domain.vertices[b] - domain.vertices[a]).cross(domain.vertices[c] - domain.vertices[a]);
    Vec3 centre = Vec3::Zero();
    for (const auto v : domain.tets[facet.tet])
      centre += domain.vertices[v] / 4;
    EXPECT_GT(normal.dot(domain.vertices[a] - centre), 0);
  }
}

TEST(Domain, complaints_name_the_file_and_the_fault) {
  Domain flipped = one_tet();
  std::swap(flipped.tets[0][0], flipped.tets[0][1]);
  EXPECT_NE(complaint(flipped).find("not a positive one"), std::string::npos);
  EXPECT_NE(complaint(flipped).find("part.step"), std::string::npos);

  Domain flat = one_tet();
  flat.vertices[3] = Vec3(0.5, 0.5, 0);
  EXPECT_NE(complaint(flat).find("not a positive one"), std::string::npos);

  Domain open = box_domain(Vec3::Zero(), Vec3::Ones(), 2);
  open.facets.erase(open.facets.begin() + 5);
  EXPECT_NE(complaint(open).find("open: 3 edges"), std::string::npos) << complaint(open);

  Domain inwards = one_tet();
  std::swap(inwards.facets[2].vertices[0], inwards.facets[2].vertices[1]);
  EXPECT_NE(complaint(inwards).find("faces inwards"), std::string::npos);

  Domain orphan = box_domain(Vec3::Zero(), Vec3::Ones(), 2);
  orphan.facets[3].tet = (orphan.facets[3].tet + 17) % static_cast<std::int32_t>(orphan.tets.size());
  EXPECT_NE(complaint(orphan).find("not a face of its tetrahedron"), std::string::npos);

  Domain unnamed = one_tet();
  unnamed.facets[1].surface = 1;
  EXPECT_NE(complaint(unnamed).find("lies on no surface"), std::string::npos);

  Domain wild = one_tet();
  wild.tets[0][2] = 4;
  EXPECT_NE(complaint(wild).find("vertex that is not there"), std::string::npos);

  Domain nan = one_tet();
  nan.vertices[1][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(complaint(nan).find("finite"), std::string::npos);

  Domain bare = one_tet();
  bare.facets.clear();
  EXPECT_NE(complaint(bare).find("no boundary"), std::string::npos);
}

/// Curves meeting at each corner, and the number of curves.
std::map<std::int32_t, std::set<std::int32_t>> curves_at_corners(const Domain& domain) {
  std::map<std::int32_t, std::set<std::int32_t>> at;
  for (const auto v : domain.corners)
    at[v];
  for (const auto& edge : domain.feature_edges)
    for (const auto v : edge.vertices)
      if (at.contains(v))
        at[v].insert(edge.curve);
  return at;
}

TEST(SupportDomains, box_and_l_have_the_entities_of_their_cad_twins) {
  for (const int n : {1, 3}) {
    const Domain box = box_domain(Vec3(-1, 2, 0), Vec3(1, 3, 5), n);
    EXPECT_NEAR(box.volume, 10, 1e-13);
    EXPECT_EQ(box.surfaces.size(), 6u);
    EXPECT_EQ(box.corners.size(), 8u);
    EXPECT_EQ(box.feature_edges.size(), 12u * n);
    for (const auto& [v, curves] : curves_at_corners(box))
      EXPECT_EQ(curves.size(), 3u);
    EXPECT_EQ(complaint(box), "");

    const Domain bent = l_domain(n, 0.5, Vec3(1, 1, 1));
    EXPECT_NEAR(bent.volume, 3 * 0.125, 1e-14);
    EXPECT_EQ(bent.surfaces.size(), 8u);
    EXPECT_EQ(bent.corners.size(), 12u);
    EXPECT_EQ(bent.feature_edges.size(),
              (2u * 8 + 6) * n); // two outlines of length 8, six uprights of length 1
    for (const auto& [v, curves] : curves_at_corners(bent))
      EXPECT_EQ(curves.size(), 3u);
    EXPECT_EQ(complaint(bent), "");
  }
}

} // namespace
} // namespace tessera::preprocess

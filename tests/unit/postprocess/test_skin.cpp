#include "postprocess/cut_body.hpp"
#include "postprocess/outline.hpp"
#include "postprocess/refine.hpp"
#include "postprocess/skin.hpp"
#include "preprocess/geometry/body_mesh.hpp"
#include "tests/support/clouds.hpp"
#include "tests/support/domains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace tessera::post {
namespace {

BodyMesh l_body() {
  return preprocess::body_mesh(test::l_domain(1));
}

double volume_of(const BodyMesh& mesh) {
  double volume = 0;
  for (const auto& [a, b, c, d] : mesh.solids) {
    const Vec3 ab = mesh.points[b] - mesh.points[a], ac = mesh.points[c] - mesh.points[a];
    volume += std::abs(ab.cross(ac).dot(mesh.points[d] - mesh.points[a])) / 6;
  }
  return volume;
}

/// The sum of the polygons' areas, and that of their vectors.
std::pair<double, Vec3> area_of(const std::vector<Vec3>& points, const std::vector<CutBody::Polygon>& faces) {
  double sum = 0;
  Vec3 whole = Vec3::Zero();
  for (const auto& face : faces) {
    Vec3 area = Vec3::Zero();
    for (std::size_t k = 2; k < face.size(); ++k)
      area += 0.5 * (points[face[k - 1]] - points[face[0]]).cross(points[face[k]] - points[face[0]]);
    sum += area.norm();
    whole += area;
  }
  return {sum, whole};
}

TEST(Refine, NothingGapesAndNothingIsLong) {
  const BodyMesh coarse = l_body(), fine = refined(coarse, 0.3);
  EXPECT_NEAR(volume_of(fine), 3, 1e-12);
  EXPECT_GT(fine.solids.size(), 10 * coarse.solids.size());
  for (const auto& solid : fine.solids)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_LE((fine.points[solid[i]] - fine.points[solid[j]]).norm(), 0.3);
  // Each triangle is shared by two solids, or is one of the refined faces.
  std::map<std::set<std::int32_t>, int> sides;
  for (const auto& solid : fine.solids)
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::set<std::int32_t> side(solid.begin(), solid.end());
      side.erase(solid[left_out]);
      ++sides[side];
    }
  std::size_t open = 0;
  for (const auto& [side, solids] : sides)
    open += solids == 1;
  EXPECT_EQ(open, fine.faces.size());
  for (const auto& face : fine.faces)
    EXPECT_EQ(sides.at({face.begin(), face.end()}), 1);
}

TEST(CutBody, TheCutClosesTheBody) {
  const BodyMesh mesh = refined(l_body(), 0.4);
  std::vector<double> x;
  for (const Vec3& p : mesh.points)
    x.push_back(p.x() + 2 * p.y());
  // The L at x = 0.7 is 2 high, at y = 1.3 one wide; both are 1 thick.
  for (const auto& [plane, area, outwards] :
       {std::tuple{CutPlane{0, 0.7, 1}, 2.0, Vec3(-1, 0, 0)}, {CutPlane{1, 1.3, -1}, 1.0, Vec3(0, 1, 0)}}) {
    const CutBody half = cut_body(mesh, x, plane);
    EXPECT_NEAR(area_of(half.points, half.section).first, area, 1e-12);
    const auto [outside, sum] = area_of(half.points, half.skin);
    EXPECT_NEAR((sum + area * outwards).norm(), 0, 1e-12) << "skin and section close";
    double rim = 0;
    for (const auto& [a, b] : half.rim)
      rim += (half.points[a] - half.points[b]).norm();
    EXPECT_NEAR(rim, 2 * (area + 1), 1e-12);
    for (std::size_t p = 0; p < half.points.size(); ++p) {
      EXPECT_GE(plane.beyond(half.points[p]), -1e-12);
      EXPECT_NEAR(half.values[p], half.points[p].x() + 2 * half.points[p].y(), 1e-12);
    }
  }
}

TEST(Outline, OfABoxIsWhatADraughtsmanDraws) {
  const CutBody box = whole_body(preprocess::body_mesh(test::box_domain()), {});
  const auto length = [&](const Vec3& into) {
    double sum = 0;
    for (const auto& [a, b] : outline_of(box, into.normalized()))
      sum += (a - b).norm();
    return sum;
  };
  EXPECT_NEAR(length({0, 1, 0}), 4, 1e-12) << "one face";
  EXPECT_NEAR(length({1, 1, 1}), 9, 1e-12) << "three faces, without the edges behind";
}

TEST(Outline, ARoundBodyHasASilhouette) {
  // The bore counts as one smooth surface: obliquely seen it turns away along lines that are no edges.
  const BodyMesh mesh = preprocess::body_mesh(test::holed_domain(4));
  const auto lines = outline_of(whole_body(mesh, {}), Vec3(1, 0.2, -1).normalized());
  const auto along_z = [](const auto& line) {
    const Vec3 way = line[1] - line[0];
    const Vec3 from = line[0] - Vec3(0.5, 0.5, 0);
    return way.head<2>().norm() < 1e-12 && std::hypot(from.x(), from.y()) < 0.31;
  };
  EXPECT_GE(std::count_if(lines.begin(), lines.end(), along_z), 2);
}

TEST(Skin, LinearFieldsComeOutExactly) {
  const ParticleCloud cloud = test::jittered(test::box_lattice(6, 6, 6, Vec3::Ones()), 0.2, 1);
  for (const bool inside : {false, true}) {
    const Skin skin = skin_of(preprocess::body_mesh(test::box_domain()), cloud, inside);
    EXPECT_EQ(skin.mesh.solids.empty(), !inside);
    ASSERT_EQ(skin.at.size(), skin.mesh.points.size());
    const Mat3 F = (Mat3() << 1.2, 0.3, 0, -0.1, 0.9, 0.2, 0.05, 0, 1.1).finished();
    std::vector<Vec3> u;
    std::vector<double> f;
    for (const Vec3& X : cloud.X) {
      u.emplace_back(F * X - X);
      f.push_back(3 - X.y());
    }
    const std::vector<Vec3> x = moved(skin, u);
    const std::vector<double> values = values_on(skin, f);
    for (std::size_t p = 0; p < x.size(); ++p) {
      EXPECT_NEAR((x[p] - F * skin.mesh.points[p]).norm(), 0, 1e-11);
      EXPECT_NEAR(values[p], 3 - skin.mesh.points[p].y(), 1e-11);
    }
  }
}

TEST(Skin, APartWithoutParticlesFollowsTheNearest) {
  const ParticleCloud cloud = test::box_lattice(4, 4, 4, Vec3::Ones());
  const Skin skin =
      skin_of(preprocess::body_mesh(test::box_domain(Vec3::Zero(), Vec3(1, 1, 9))), cloud, false);
  std::vector<Vec3> u(cloud.X.size(), Vec3(0, 0, 2));
  for (std::size_t p = 0; const Vec3& x : moved(skin, u))
    EXPECT_NEAR((x - skin.mesh.points[p++] - u[0]).norm(), 0, 1e-12);
}

} // namespace
} // namespace tessera::post

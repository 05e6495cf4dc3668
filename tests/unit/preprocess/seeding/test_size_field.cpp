#include "preprocess/seeding/size_field.hpp"

#include "core/error.hpp"
#include "preprocess/seeding/box_tree.hpp"
#include "preprocess/seeding/nearness.hpp"
#include "preprocess/seeding/random.hpp"
#include "preprocess/seeding/tet_locator.hpp"
#include "tests/support/domains.hpp"
#include "tests/support/slabs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tessera::preprocess {
namespace {

TEST(SizeField, IsEmptyWithoutRefinements) {
  const Domain box = test::box_domain();
  EXPECT_FALSE(size_field(box, {}, false));
  EXPECT_EQ(graded_volume(box, {}), 1);
}

TEST(SizeField, GrowsLinearlyAwayFromAPoint) {
  const Domain box = test::box_domain();
  const SizeField size = size_field(box, {{Vec3(0.5, 0.5, 0.5), 0.2, 0.1, 0.3}}, false);
  EXPECT_DOUBLE_EQ(size(Vec3(0.55, 0.5, 0.5)), 0.2);
  EXPECT_NEAR(size(Vec3(0.5, 0.7, 0.5)), 0.6, 1e-14);
  EXPECT_EQ(size(Vec3(0, 0, 0)), 1);
  // Of a ball of radius 0.1 and a shell around it, by quadrature.
  double expected =
      1 - 4. / 3 * std::numbers::pi * std::pow(0.3, 3) + 4. / 3 * std::numbers::pi * 1e-3 / 0.008;
  for (int k = 0; k < 2000; ++k) {
    const double r = 0.1 + 0.2 * (k + 0.5) / 2000;
    expected += 4 * std::numbers::pi * r * r * (0.2 / 2000) / std::pow(0.2 + 4 * (r - 0.1), 3);
  }
  EXPECT_NEAR(graded_volume(box, size), expected, 0.01 * expected);
}

TEST(SizeField, KnowsTheDistanceFromSetsOfEveryDimension) {
  Domain box = test::box_domain(Vec3::Zero(), Vec3::Ones(), 4);
  box.groups.push_back({"edge", 1, {}, {box.feature_edges[0].curve}, {}});
  box.groups.push_back({"corner", 0, {}, {}, {box.corners[0]}});
  box.groups.push_back({"ends", 2, {0, 1}, {}, {}});
  RandomPoints random(box, 3);
  const auto field = [&](const char* name) {
    return size_field(box, {{std::string(name), 0.1, 0, 2}}, false);
  };
  const SizeField face = field("xmax"), ends = field("ends"), edge = field("edge"), corner = field("corner");
  const Vec3 C = box.vertices[box.corners[0]];
  const Vec3 A = box.vertices[box.feature_edges[0].vertices[0]],
             B = box.vertices[box.feature_edges[0].vertices[1]];
  for (int i = 0; i < 200; ++i) {
    const Vec3 X = random.next();
    EXPECT_NEAR(face(X), 0.1 + 0.45 * (1 - X.x()), 1e-14);
    EXPECT_NEAR(ends(X), 0.1 + 0.45 * std::min(X.x(), 1 - X.x()), 1e-14);
    EXPECT_NEAR(edge(X), 0.1 + 0.45 * (X - A).cross((B - A).normalized()).norm(), 1e-14);
    EXPECT_NEAR(corner(X), 0.1 + 0.45 * (X - C).norm(), 1e-14);
  }
}

TEST(SizeField, MeasuresFromTheWallsOfASlab) {
  const Domain slab = test::square_slab(3, 100);
  const std::string& wall = slab.surfaces[0];
  const SizeField size = size_field(slab, {{wall, 0.5, 0, 100}, {Vec3(50, 50, 0), 0.1, 5, 5}}, false);
  Vec3 on = Vec3::Zero();
  for (const auto& edge : slab.feature_edges)
    if (edge.curve == 0)
      on = slab.vertices[edge.vertices[0]];
  on.z() = 0;
  EXPECT_NEAR(size(on), 0.5, 1e-14);
  EXPECT_NEAR(size(on + 0.2 * (Vec3(50, 50, 0) - on)), 0.55, 1e-12);
  EXPECT_EQ(size(Vec3(51, 50, 0)), 0.1);
}

TEST(SizeField, FollowsTheMesh) {
  // Cells that double in width from x to x: edges do not, but grow.
  Domain box = test::box_domain(Vec3::Zero(), Vec3::Ones(), 6);
  for (Vec3& X : box.vertices)
    X.x() *= X.x();
  box.measure();
  const SizeField size = size_field(box, {}, true);
  double largest = 0;
  for (const Vec3& X : box.vertices) {
    largest = std::max(largest, size(X));
    EXPECT_GT(size(X), 0.2);
  }
  EXPECT_NEAR(largest, 1, 1e-12);
  EXPECT_LT(size(Vec3(0.01, 0.5, 0.5)), size(Vec3(0.95, 0.5, 0.5)));
  // Linear inside a tetrahedron; carried on a little way out of the body.
  const auto& tet = box.tets[77];
  Vec3 middle = Vec3::Zero();
  double mean = 0;
  for (const std::int32_t v : tet) {
    middle += box.vertices[v] / 4;
    mean += size(box.vertices[v]) / 4;
  }
  EXPECT_NEAR(size(middle), mean, 1e-12);
  EXPECT_NEAR(size(Vec3(1.001, 0.4, 0.4)), size(Vec3(1, 0.4, 0.4)), 0.01);
}

TEST(SizeField, SaysWhatIsWrong) {
  const Domain box = test::box_domain();
  const auto message = [&](const Refinement& refinement) -> std::string {
    try {
      size_field(box, {refinement}, false);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message({std::string("xmas"), 0.5, 0, 1}).find("\"xmax\""), std::string::npos);
  const Vec3 X = Vec3::Zero();
  EXPECT_NE(message({X, 0.001, 0, 1}).find("factor"), std::string::npos);
  EXPECT_NE(message({X, 1.1, 0, 1}).find("factor"), std::string::npos);
  EXPECT_NE(message({X, std::nan(""), 0, 1}).find("factor"), std::string::npos);
  EXPECT_NE(message({X, 0.5, 2, 1}).find("within"), std::string::npos);
  EXPECT_NE(message({X, 0.5, -1, 1}).find("within"), std::string::npos);
  EXPECT_NE(message({Vec3(0, std::nan(""), 0), 0.5, 0, 1}).find("point"), std::string::npos);
}

TEST(BoxTree, FindsWhatABruteForceSearchFinds) {
  const Domain ell = test::l_domain(3);
  const TetLocator locator(ell, ell.vertices);
  std::vector<Box> boxes;
  for (const auto& facet : ell.facets) {
    const Vec3 &a = ell.vertices[facet.vertices[0]], &b = ell.vertices[facet.vertices[1]],
               &c = ell.vertices[facet.vertices[2]];
    boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
  }
  const BoxTree tree(boxes);
  RandomNumbers numbers(5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 X(3 * numbers.next() - 0.5, 3 * numbers.next() - 0.5, 2 * numbers.next() - 0.5);
    const bool inside =
        X.minCoeff() >= 0 && X.x() <= 2 && X.y() <= 2 && X.z() <= 1 && (X.x() <= 1 || X.y() <= 1);
    const std::int32_t tet = locator.locate(X);
    ASSERT_EQ(tet >= 0, inside);
    if (inside) {
      EXPECT_NEAR(locator.weights(tet, X).sum(), 1, 1e-13);
    }
    const auto distance = [&](std::int32_t f) {
      const auto& v = ell.facets[f].vertices;
      return (X - nearest_on_triangle(X, {ell.vertices[v[0]], ell.vertices[v[1]], ell.vertices[v[2]]}))
          .squaredNorm();
    };
    double least = distance(0);
    for (std::int32_t f = 1; f < static_cast<std::int32_t>(boxes.size()); ++f)
      least = std::min(least, distance(f));
    EXPECT_EQ(tree.nearest(X, distance).second, least);
  }
}

} // namespace
} // namespace tessera::preprocess

#include "core/error.hpp"
#include "preprocess/geometry/features.hpp"
#include "preprocess/geometry/slab.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace tessera::preprocess {
namespace {

/// [0,2]x[0,1] in n by n cells, with vertices numbered in a scrambled order, half the triangles turned.
PlaneFigure rectangle(int n) {
  PlaneFigure figure;
  const int points = (n + 1) * (n + 1);
  const auto number = [&](int i, int j) { return ((i * (n + 1) + j) * 7 + 3) % points; };
  figure.vertices.resize(points);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      figure.vertices[number(i, j)] = {2.0 * i / n, 1.0 * j / n};
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      figure.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      figure.triangles.push_back({number(i, j), number(i, j + 1), number(i + 1, j + 1)});
    }
  return figure;
}

TEST(Slab, is_a_valid_domain_of_unit_thickness) {
  PlaneFigure figure = rectangle(4); // 25 vertices: 7 and 25 have no common factor
  find_sides(figure, "here");
  EXPECT_EQ(figure.sides.size(), 16u);
  curves_by_angle(figure, 40);
  EXPECT_EQ(figure.curves, (std::vector<std::string>{"edge1", "edge2", "edge3", "edge4"}));
  Domain slab = draw_out(figure);
  EXPECT_NO_THROW(slab.validate("here"));
  EXPECT_EQ(slab.dimension, 2);
  EXPECT_EQ(slab.tets.size(), 3 * 32u);
  EXPECT_NEAR(slab.volume, 2, 1e-15);
  EXPECT_EQ(slab.lower, Vec3(0, 0, 0));
  EXPECT_EQ(slab.upper, Vec3(2, 1, 0));
  // Matching neighbours: the boundary is two lids of 32 triangles and 16 walls of two.
  EXPECT_EQ(slab.facets.size(), 2 * 32u + 2 * 16u);
  std::map<std::int32_t, double> area;
  for (const auto& facet : slab.facets) {
    const Vec3& A = slab.vertices[facet.vertices[0]];
    area[facet.surface] +=
        (slab.vertices[facet.vertices[1]] - A).cross(slab.vertices[facet.vertices[2]] - A).norm() / 2;
  }
  EXPECT_NEAR(area[Domain::lid], 4, 1e-14);
  double around = 0;
  for (std::int32_t c = 0; c < 4; ++c)
    around += area[c];
  EXPECT_NEAR(around, 6, 1e-14);
  ASSERT_EQ(slab.feature_edges.size(), 16u);
  for (const auto& edge : slab.feature_edges)
    for (const auto v : edge.vertices)
      EXPECT_EQ(slab.vertices[v][2], 0.5);
  find_corners(slab, {});
  ASSERT_EQ(slab.corners.size(), 4u);
  for (const auto v : slab.corners)
    EXPECT_EQ(slab.vertices[v][2], 0.5);
}

TEST(Slab, a_round_figure_has_one_curve_and_no_corner_and_a_curves_end_is_one) {
  const int n = 24;
  PlaneFigure figure;
  for (int i = 0; i < n; ++i)
    figure.vertices.emplace_back(std::cos(2 * std::numbers::pi * i / n),
                                 std::sin(2 * std::numbers::pi * i / n));
  figure.vertices.emplace_back(0, 0);
  for (int i = 0; i < n; ++i)
    figure.triangles.push_back({n, i, (i + 1) % n});
  find_sides(figure, "here");
  curves_by_angle(figure, 40);
  EXPECT_EQ(figure.curves.size(), 1u);
  Domain slab = draw_out(figure);
  find_corners(slab, {});
  EXPECT_TRUE(slab.corners.empty());

  figure.curves = {"east", "west"};
  for (auto& side : figure.sides)
    side.curve = figure.vertices[side.vertices[0]][0] + figure.vertices[side.vertices[1]][0] > 1e-9 ? 0 : 1;
  slab = draw_out(figure);
  find_corners(slab, {});
  EXPECT_EQ(slab.corners.size(), 2u);
}

std::string complaint(PlaneFigure figure) {
  try {
    find_sides(figure, "plate.msh");
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Slab, figures_that_are_none_are_refused) {
  PlaneFigure flat = rectangle(2);
  flat.triangles[3] = {flat.triangles[3][0], flat.triangles[3][1], flat.triangles[3][1]};
  EXPECT_NE(complaint(flat).find("triangle 4 of the plane mesh has no area"), std::string::npos);

  PlaneFigure folded;
  folded.vertices = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  folded.triangles = {{0, 1, 2}, {0, 1, 3}};
  EXPECT_NE(complaint(folded).find("folds over itself"), std::string::npos);

  PlaneFigure book = folded;
  book.vertices.emplace_back(0.5, -1);
  book.triangles.push_back({1, 0, 4});
  EXPECT_NE(complaint(book).find("3 triangles of the plane mesh share one edge"), std::string::npos);
  EXPECT_NE(complaint(book).find("near (0.5, 0)"), std::string::npos);
}

TEST(Slab, validation_knows_lids_from_walls) {
  PlaneFigure figure = rectangle(2); // 9 vertices
  find_sides(figure, "here");
  curves_by_angle(figure, 40);
  const Domain slab = draw_out(figure);
  const auto says = [](const Domain& domain) {
    try {
      domain.validate("here");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(says(slab), "");
  Domain painted = slab, bare = slab, thick = slab, solid = slab;
  for (auto& facet : painted.facets)
    if (facet.surface == Domain::lid)
      facet.surface = 0;
  EXPECT_NE(says(painted).find("is a lid's but lies on a surface"), std::string::npos);
  for (auto& facet : bare.facets)
    facet.surface = Domain::lid;
  EXPECT_NE(says(bare).find("lies on no surface"), std::string::npos);
  for (Vec3& X : thick.vertices)
    X[2] *= 2;
  EXPECT_NE(says(thick).find("on neither lid"), std::string::npos);
  solid.dimension = 3;
  EXPECT_NE(says(solid).find("lies on no surface"), std::string::npos);
}

} // namespace
} // namespace tessera::preprocess

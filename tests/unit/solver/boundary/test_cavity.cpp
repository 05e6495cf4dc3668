#include "solver/boundary/cavity.hpp"

#include "solver/boundary/plane.hpp"

#include <gtest/gtest.h>

#include <vector>

using namespace tessera;
using namespace tessera::solver;

namespace {

class Ball final : public RigidShape {
 public:
  Gap gap(const Vec3& x) const override { return {x.norm() - 1, x.stableNormalized()}; }
  bool two_sided() const override { return true; }
};

} // namespace

TEST(Cavity, TurnsDistanceAndNormalAround) {
  const RigidShape::Gap gap = Cavity(std::make_shared<Ball>()).gap({0.25, 0, 0});
  EXPECT_DOUBLE_EQ(gap.distance, 0.75);
  EXPECT_EQ(gap.normal, Vec3(-1, 0, 0));
}

TEST(Cavity, IsChosenByTheParticleFarthestFromTheSurface) {
  const std::shared_ptr<const RigidShape> ball = std::make_shared<Ball>();
  const std::vector<Vec3> inside = {{0, 0, 0}, {1.01, 0, 0}}, outside = {{0.99, 0, 0}, {2, 0, 0}};
  EXPECT_GT(on_the_bodys_side(ball, inside)->gap(inside[0]).distance, 0);
  EXPECT_EQ(on_the_bodys_side(ball, outside), ball);
}

TEST(Cavity, IsNotForShapesWithOneFreeSide) {
  const std::shared_ptr<const RigidShape> floor = std::make_shared<Plane>();
  EXPECT_EQ(on_the_bodys_side(floor, std::vector<Vec3>{{0, 0, -1}}), floor);
}

#include "postprocess/tool.hpp"
#include "solver/boundary/plane.hpp"
#include "solver/boundary/polyline.hpp"

#include <gtest/gtest.h>

namespace tessera::post {
namespace {

TEST(Tool, PlanesAndLinesOfTheWalls) {
  std::vector<solver::WallSpec> walls(3);
  walls[0].shape = std::make_shared<solver::Plane>(Vec3(1, 2, 3), Vec3(0, 0, 2));
  walls[0].velocity = {0, 0, -1};
  walls[1].shape = nullptr; // a surface that is not read
  walls[2].shape =
      std::make_shared<solver::Polyline>(std::vector<Vec<2>>{{0, 0}, {1, 0}}, std::vector<double>{});
  const std::vector<Tool> tools = tools_of(walls, 5);
  ASSERT_EQ(tools.size(), 2u);
  EXPECT_EQ(tools[0].normal, Vec3(0, 0, 1));
  EXPECT_NEAR(tools[0].point.z(), 3, 1e-12);
  EXPECT_EQ(tools[0].velocity, Vec3(0, 0, -1));
  EXPECT_TRUE(tools[0].line.empty());
  ASSERT_EQ(tools[1].line.size(), 2u);
  EXPECT_EQ(tools[1].line[0], Vec3(-5, 0, 0));
  EXPECT_EQ(tools[1].line[1], Vec3(5, 0, 0));
}

} // namespace
} // namespace tessera::post

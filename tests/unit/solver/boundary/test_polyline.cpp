#include "solver/boundary/polyline.hpp"

#include "core/error.hpp"
#include "tests/unit/solver/boundary/free_particle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace tessera;
using namespace tessera::solver;

namespace {

using Point = Vec<2>;

Vec3 in_space(const Point& x) {
  return {x[0], x[1], 0};
}

double distance(const RigidShape& shape, double x, double y) {
  return shape.gap({x, y, 0}).distance;
}

/// Points along a rounded line, its ends prolonged by `reach`, drawn without looking at Polyline's own way:
/// each corner's arc by turning the tangent.
std::vector<Point> drawn(std::vector<Point> points, const std::vector<double>& fillets, double reach,
                         double step) {
  points.front() -= reach * (points[1] - points[0]).normalized();
  points.back() += reach * (points.back() - points[points.size() - 2]).normalized();
  std::vector<Point> samples;
  Point pen = points[0];
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point along = (points[i + 1] - points[i]).normalized();
    double turn = 0, radius = 0;
    if (i + 2 < points.size()) {
      const Point next = (points[i + 2] - points[i + 1]).normalized();
      turn = std::atan2(along[0] * next[1] - along[1] * next[0], along.dot(next));
      radius = fillets[i];
    }
    const Point end = points[i + 1] - radius * std::tan(std::abs(turn) / 2) * along;
    const int pieces = 1 + static_cast<int>((end - pen).norm() / step);
    for (int k = 0; k < pieces; ++k)
      samples.push_back(pen + (end - pen) * k / pieces);
    pen = end;
    const double arc = radius * std::abs(turn);
    const int chords = static_cast<int>(arc / step) + 1;
    const double bit = turn / chords, chord = 2 * radius * std::sin(std::abs(bit) / 2);
    for (int k = 0; k < chords && radius > 0; ++k) {
      samples.push_back(pen);
      pen += chord * (Eigen::Rotation2Dd((k + 0.5) * bit) * along);
    }
  }
  samples.push_back(points.back());
  return samples;
}

/// Whether x is to the left of the drawn line closed far off by the box of its ends: crossings of a ray.
bool left_of(const std::vector<Point>& closed, const Point& x) {
  bool inside = false;
  for (std::size_t i = 0, j = closed.size() - 1; i < closed.size(); j = i++)
    if ((closed[i][1] > x[1]) != (closed[j][1] > x[1]) &&
        x[0] < (closed[j][0] - closed[i][0]) * (x[1] - closed[i][1]) / (closed[j][1] - closed[i][1]) +
                   closed[i][0])
      inside = !inside;
  return inside;
}

void compare_with_samples(const std::vector<Point>& points, const std::vector<double>& fillets,
                          const std::vector<Point>& closing) {
  const Polyline line(points, fillets);
  const double step = 1e-3;
  const std::vector<Point> samples = drawn(points, fillets, 10, step);
  std::vector<Point> closed = samples;
  closed.insert(closed.end(), closing.begin(), closing.end());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1, 4);
  for (int i = 0; i < 400; ++i) {
    const Point x(place(random), place(random));
    const Point* nearest = &samples[0];
    for (const Point& s : samples)
      if ((s - x).squaredNorm() < (*nearest - x).squaredNorm())
        nearest = &s;
    const double far = (x - *nearest).norm();
    const RigidShape::Gap gap = line.gap(in_space(x));
    const double found = std::abs(gap.distance);
    EXPECT_LE(found, far + 1e-9) << x.transpose();
    EXPECT_GE(std::max(std::hypot(found, step), found + 1e-5), far) << x.transpose();
    EXPECT_EQ(gap.distance > 0, left_of(closed, x)) << x.transpose() << " " << gap.distance;
    EXPECT_NEAR(gap.normal.norm(), 1, 1e-12);
    // The normal is the distance's own gradient, and leads back to the surface.
    const double h = 1e-6;
    if (std::abs(gap.distance) > 1e-3) {
      EXPECT_NEAR(line.gap(in_space(x) - gap.distance * gap.normal).distance, 0, 1e-12);
      EXPECT_NEAR(line.gap(in_space(x) - h * gap.distance * gap.normal).distance, (1 - h) * gap.distance,
                  1e-12);
    }
  }
}

} // namespace

TEST(Polyline, DistanceSignAndNormalAgreeWithManyPointsDrawnAlongIt) {
  // A step up and a notch down, as a floor: free above. Rounded, sharp and both.
  const std::vector<Point> points = {{-1, 0}, {1, 0}, {1, 1}, {2, 1}, {2.5, 0.2}, {4, 0.2}};
  const std::vector<Point> above = {{20, 20}, {-20, 20}};
  compare_with_samples(points, {0.4, 0.3, 0.2, 0.15}, above);
  compare_with_samples(points, {0, 0, 0, 0}, above);
  compare_with_samples(points, {0.5, 0, 0.3, 0}, above);
  // Acute corners, and a spike.
  compare_with_samples({{-1, 0}, {1, 0}, {1.2, 2}, {1.4, 0}, {3, 0}}, {0.1, 0, 0.2}, above);
  compare_with_samples({{-1, 0}, {1, 0}, {0.5, 1}, {4, 1}}, {0.1, 0.05}, {{20, 1}, {20, 20}, {-20, 20}});
}

TEST(Polyline, ASharpCornerIsNearestOverItsWholeSector) {
  // The quadrant x < 0, y < 0 is free, and then it is the tool.
  const Polyline notch({{0, -1}, {0, 0}, {-1, 0}}, {0});
  EXPECT_DOUBLE_EQ(distance(notch, -3, -4), 3);
  EXPECT_DOUBLE_EQ(distance(notch, 3, 4), -5);
  EXPECT_LT((notch.gap({3, 4, 0}).normal - Vec3(-0.6, -0.8, 0)).norm(), 1e-15);
  const Polyline corner({{-1, 0}, {0, 0}, {0, -1}}, {0});
  EXPECT_DOUBLE_EQ(distance(corner, 3, 4), 5);
  EXPECT_LT((corner.gap({3, 4, 0}).normal - Vec3(0.6, 0.8, 0)).norm(), 1e-15);
  EXPECT_DOUBLE_EQ(distance(corner, -3, -4), -3);
  EXPECT_LT((corner.gap({-3, -4, 0}).normal - Vec3(1, 0, 0)).norm(), 1e-15);
}

TEST(Polyline, GoesOnForEverAtBothEnds) {
  const Polyline floor({{0, 0}, {1, 0}}, {});
  EXPECT_EQ(distance(floor, 1e6, 2), 2);
  EXPECT_EQ(distance(floor, -1e6, -2), -2);
}

TEST(Polyline, RefusesLinesThatAreNone) {
  const auto message = [](const std::vector<Point>& points, const std::vector<double>& fillets) {
    try {
      Polyline(points, fillets, "case.toml:7:1");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(message({{0, 0}}, {}), "a wall's line has 1 points, case.toml:7:1, give two or more");
  EXPECT_NE(message({{0, 0}, {1, 1}, {1, 1}}, {0}).find("point 3 of a wall's line, (1, 1), repeats"),
            std::string::npos);
  EXPECT_NE(message({{0, 0}, {1, 0}, {0.5, 0}}, {0}).find("turns back on itself at (1, 0)"),
            std::string::npos);
  EXPECT_NE(message({{0, 0}, {1, 0}, {1, 1}}, {0.1, 0.1}).find("3 points lists 2 fillets"),
            std::string::npos);
  EXPECT_NE(message({{0, 0}, {1, 0}, {1, 1}}, {-0.1}).find("a fillet of a wall's line is -0.1"),
            std::string::npos);
  EXPECT_NE(message({{0, 0}, {1, 0}, {1, 1}}, {1.01}).find("1.01 m at (1, 0) does not fit"),
            std::string::npos);
  EXPECT_NE(message({{0, 0}, {1, 0}, {1, 1}, {3, 1}}, {0.6, 0.5})
                .find("the piece of 1 m beside it would need 1.1 m"),
            std::string::npos);
  EXPECT_EQ(message({{0, 0}, {1, 0}, {1, 1}}, {1}), "");
  EXPECT_NE(
      message({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, -1}}, {}).find("pieces 1 and 4 of a wall's line cross"),
      std::string::npos);
  EXPECT_NE(message({{0, 0}, {1, 0}, {1, 1}, {0.5, 1}, {0.4, 0.5}}, {}), ""); // once prolonged
}

namespace {

/// The extrusion die: down, to the right, down again, 8 mm wide, 24 mm from centre to centre.
const std::vector<Point> die_path = {{0.004, 0.056}, {0.004, -0.004}, {0.028, -0.004}, {0.028, -0.048}};

Channel die() {
  return channel(die_path, 0.008, 0.0015, 0.001);
}

} // namespace

TEST(Channel, HasTheSidesOfTheExtrusionDie) {
  const auto [left, right] = die();
  const double mm = 1e-3;
  const auto both = [&, l = left, r = right](double x, double y) {
    return std::array{distance(*l, x * mm, y * mm) / mm, distance(*r, x * mm, y * mm) / mm};
  };
  // In the entry, the middle channel and the exit: the free side is inside.
  EXPECT_NEAR(both(2, 40)[1], 2, 1e-12);
  EXPECT_NEAR(both(2, 40)[0], 6, 1e-12);
  EXPECT_NEAR(both(16, -3)[0], 3, 1e-12);
  EXPECT_NEAR(both(16, -3)[1], 5, 1e-12);
  EXPECT_NEAR(both(30, -40)[0], 2, 1e-12);
  EXPECT_NEAR(both(30, -40)[1], 6, 1e-12);
  // Outside on either side.
  EXPECT_LT(both(-1, 40)[1], 0);
  EXPECT_LT(both(12, 5)[0], 0);
  // Arcs touch where the CAD drawing of the die has them: outer centre (1.5, -6.5), inner centre (9, 1).
  const double c = std::sqrt(0.5);
  EXPECT_NEAR(both(1.5 - 1.5 * c, -6.5 - 1.5 * c)[1], 0, 1e-12);
  EXPECT_NEAR(both(9 - c, 1 - c)[0], 0, 1e-12);
  EXPECT_NEAR(both(9 - 2 * c, 1 - 2 * c)[0], 1, 1e-12);
  EXPECT_NEAR(both(9, 1)[0], -1, 1e-12);
  // The second turn is to the other hand: outer on the left, centre (30.5, -1.5); inner on the right, (23,
  // -9).
  EXPECT_NEAR(both(30.5 + 1.5 * c, -1.5 + 1.5 * c)[0], 0, 1e-12);
  EXPECT_NEAR(both(23 + c, -9 + c)[1], 0, 1e-12);
}

TEST(Channel, MayTurnByAnyAngle) {
  const auto [left, right] = channel({{0, 0}, {1, 0}, {2, 1}, {4, 1}}, 0.2, 0.1, 0.05);
  const Vec3 at(1.5, 0.5, 0);
  EXPECT_NEAR(left->gap(at).distance, 0.1, 1e-12);
  EXPECT_NEAR(right->gap(at).distance, 0.1, 1e-12);
  EXPECT_LT((left->gap(at).normal - Vec3(1, -1, 0).normalized()).norm(), 1e-12);
  // Both miters on the bisector of a turn, sharp.
  const Channel sharp = channel({{0, 0}, {1, 0}, {2, 1}}, 0.2, 0, 0);
  const double reach = 0.1 / std::cos(M_PI / 8);
  const Vec3 bisector(-std::sin(M_PI / 8), std::cos(M_PI / 8), 0);
  EXPECT_NEAR(sharp.left->gap(Vec3(1, 0, 0) + reach * bisector).distance, 0, 1e-12);
  EXPECT_NEAR(sharp.right->gap(Vec3(1, 0, 0) - reach * bisector).distance, 0, 1e-12);
}

TEST(Channel, RefusesWhatDoesNotFit) {
  try {
    channel(die_path, 0.008, 0.03, 0.001);
    FAIL();
  } catch (const InputError& e) { // what round-off leaves of the corner's zero is not shown
    EXPECT_NE(std::string(e.what()).find("the fillet of 0.03 m at (0.032, 0) does not fit"),
              std::string::npos)
        << e.what();
  }
  EXPECT_THROW(channel({{0, 0}}, 0.1, 0, 0), InputError);
  EXPECT_THROW(channel({{0, 0}, {1, 0}}, 0, 0, 0), InputError);
  EXPECT_THROW(channel({{0, 0}, {1, 0}, {1, 0}}, 0.1, 0, 0), InputError);
  EXPECT_THROW(channel({{0, 0}, {1, 0}, {1, 1}}, 0.1, 0, 2), InputError); // fillet
  EXPECT_NO_THROW(channel({{0, 0}, {4, 0}, {4, 1}, {0, 1}}, 0.9, 0, 0));
  EXPECT_THROW(channel({{0, 0}, {4, 0}, {4, 1}, {0, 1}}, 1.1, 0, 0), InputError); // no wall left between
  EXPECT_THROW(channel({{0, 0}, {1, 0}, {1, 1}, {5, 1}}, 2.5, 0, 0), InputError);
}

TEST(Channel, AParticleDrivenIntoACornerStopsThereWhateverWallIsFirst) {
  const Channel blunt = channel({{0, 2}, {0, 0}, {3, 0}}, 1, 0, 0); // outer corner at (-0.5, -0.5)
  const Polyline tool({{-0.5, 5}, {-0.5, -0.5}, {5, -0.5}}, {});
  const auto floor = std::make_shared<Plane>(Vec3(0, -0.5, 0), Vec3::UnitY());
  const auto side = std::make_shared<Plane>(Vec3(-0.5, 0, 0), Vec3::UnitX());
  const auto slope = std::make_shared<Plane>(Vec3(-0.5, -0.5, 0), Vec3(1, 2, 0));
  const std::vector<std::vector<std::shared_ptr<const RigidShape>>> corners = {
      {blunt.left, blunt.right}, {blunt.right}, {floor, side}, {side, floor}, {side, slope},
      {slope, floor, side}};
  for (const auto& tools : corners)
    for (const double mu : {0.0, 0.1})
      for (const Vec<2>& pull : {Vec<2>(-3, -4), Vec<2>(-5, -1)}) {
        std::vector<Wall<2>> walls;
        for (const auto& shape : tools)
          walls.emplace_back("wall", shape, ContactLaw{ContactMethod::reflection, mu, 0, 0}, Vec<2>::Zero(),
                             1);
        FreeParticle<2> particle{{-0.3, -0.35}, {0, 0}, 2, walls};
        const double dt = 1e-3;
        for (int i = 0; i < 3000; ++i) {
          particle.step(dt, pull);
          for (const auto& shape : tools)
            ASSERT_GT(shape->gap(in_space(particle.x[0])).distance, -1e-9) << i;
        }
        // At rest but for what one step's pull may leave where the walls are oblique to each other.
        EXPECT_LT(particle.velocity().norm(), dt * pull.norm()) << tools.size();
        EXPECT_LT((particle.x[0] - Vec<2>(-0.5, -0.5)).norm(), dt * dt * pull.norm()) << tools.size();
      }
}

TEST(Channel, AParticlePressedAgainstARoundedEdgeDoesNotCutThroughIt) {
  // Along the floor, over its rounded end and down, drawn towards it all the way.
  const auto edge =
      std::make_shared<Polyline>(std::vector<Point>{{-1, 0}, {0, 0}, {0, -1}}, std::vector<double>{0.1});
  FreeParticle<2> particle{{-0.2, 0}, {1, 0}, 2, {Wall<2>("edge", edge, ContactLaw{}, Vec<2>::Zero(), 1)}};
  while (particle.x[0][1] > -0.2) {
    const RigidShape::Gap gap = edge->gap(in_space(particle.x[0]));
    ASSERT_GT(gap.distance, -1e-12);
    ASSERT_LT(gap.distance, 1e-4);
    ASSERT_LT(particle.time, 1);
    particle.step(1e-3, -40 * gap.normal.head<2>());
  }
}

TEST(Channel, AParticleGlidesThroughTheDieAlongItsRoundedCorners) {
  const auto [left, right] = die();
  const double speed = 1, radius = 0.0015;
  // Along the outside of the first turn without friction: what it loses there is of the order of the angle it
  // turns by in a step.
  const auto lost = [&, l = left, r = right](double dt) {
    std::vector<Wall<2>> walls;
    for (const auto& side : {l, r})
      walls.emplace_back("die", side, ContactLaw{}, Vec<2>::Zero(), 1);
    FreeParticle<2> particle{{0, 0}, {0, -speed}, 2800, walls};
    while (particle.time < 0.015) {
      particle.step(dt, {0, 0});
      EXPECT_GT(r->gap(in_space(particle.x[0])).distance, -1e-12);
    }
    EXPECT_NEAR(particle.x[0][1], -0.008, 1e-12);
    return speed - particle.velocity()[0];
  };
  const double coarse = lost(2e-6), fine = lost(1e-6);
  EXPECT_LT(fine, 3.5 * speed * 1e-6 / radius);
  EXPECT_NEAR(fine / coarse, 0.5, 0.02);
}

TEST(Polyline, IsDrawnAlongItself) {
  const Polyline line({{0, 0}, {2, 0}, {2, 3}, {5, 3}}, {0.5, 0});
  const std::vector<Point> points = line.drawn(10);
  EXPECT_NEAR((points.front() - Point(-10, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((points.back() - Point(12, 3)).norm(), 0, 1e-12);
  for (const Point& x : points)
    EXPECT_NEAR(distance(line, x[0], x[1]), 0, 1e-12);
  EXPECT_NEAR((points[1] - Point(1.5, 0)).norm(), 0, 1e-12) << "where the arc begins";
  EXPECT_NEAR((points[points.size() - 2] - Point(2, 3)).norm(), 0, 1e-12) << "a sharp corner";
  EXPECT_EQ(Polyline({{0, 0}, {1, 0}}, {}).drawn(2).size(), 2u);
}

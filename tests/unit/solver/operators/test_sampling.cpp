#include "solver/operators/sampling.hpp"

#include "core/error.hpp"
#include "tests/support/clouds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace tessera;
using namespace tessera::solver;

namespace {

/// `count` random points of the box grown by `margin` on all sides (z = 0 in the plane).
std::vector<Vec3> points(const ParticleCloud& cloud, const Vec3& size, double margin, int count) {
  std::mt19937_64 random(17);
  std::vector<Vec3> list(static_cast<std::size_t>(count), Vec3::Zero());
  for (Vec3& x : list)
    for (int c = 0; c < cloud.dimension; ++c)
      x[c] = -margin + (size[c] + 2 * margin) * static_cast<double>(random() >> 11) * 0x1p-53;
  return list;
}

template <int D>
void exact_on_linear(const ParticleCloud& cloud, const std::vector<Vec3>& at, double unit = 1) {
  const auto f = [&](const Vec3& x) { return 0.3 - 1.2 * x[0] / unit + 0.7 * x[1] / unit + 2 * x[2] / unit; };
  for (const std::string& name : kernel_names()) {
    const Kernel<D> kernel{kernel_named(name)};
    for (const Vec3& x : at) {
      const Sampling sampling = build_sampling<D>(x, cloud.X, cloud.V, {}, kernel);
      double magnitude = 0;
      for (const double w : sampling.weight)
        magnitude += std::abs(w);
      ASSERT_NEAR(sampling([](std::int32_t) { return 1.0; }), 1, 1e-12) << name << " " << x.transpose();
      ASSERT_NEAR(sampling([&](std::int32_t b) { return f(cloud.X[b]); }), f(x), 1e-12) << name;
      ASSERT_LE(magnitude, 4) << name << " " << x.transpose();
      ASSERT_TRUE(std::is_sorted(sampling.particle.begin(), sampling.particle.end()));
      for (const std::int32_t b : sampling.particle)
        ASSERT_LT((cloud.X[b] - x).norm(), sampling.support);
    }
  }
}

/// Largest error at points of the unit box of a smooth field on n^D lattice points moved by `shift` spacings.
template <int D>
double error(int n, double shift) {
  const auto cloud =
      test::jittered(test::box_lattice(n, n, D == 3 ? n : 1, Vec3(1, 1, D == 3 ? 1 : 0)), shift, 3);
  const auto f = [](const Vec3& x) { return std::sin(3 * x[0]) * std::cos(2 * x[1]) + std::exp(-x[2]); };
  double worst = 0;
  for (const Vec3& x : points(cloud, Vec3(1, 1, 1), 0, 400)) {
    const Sampling sampling = build_sampling<D>(x, cloud.X, cloud.V);
    worst = std::max(worst, std::abs(sampling([&](std::int32_t b) { return f(cloud.X[b]); }) - f(x)));
  }
  return worst;
}

std::string refusal(const Vec3& point, const ParticleCloud& cloud) {
  try {
    if (cloud.dimension == 3)
      build_sampling<3>(point, cloud.X, cloud.V);
    else
      build_sampling<2>(point, cloud.X, cloud.V);
  } catch (const InputError& refused) {
    return refused.what();
  }
  return "";
}

} // namespace

TEST(Sampling, IsExactOnLinearFieldsWithEveryKernel) {
  const Vec3 size(1.2, 1, 1.4);
  const auto lattice = test::box_lattice(7, 6, 8, size);
  const double margin = lattice.spacing / 2; // a body's face may pass by its particles
  exact_on_linear<3>(lattice, points(lattice, size, margin, 150));
  exact_on_linear<3>(lattice, {lattice.X.front(), lattice.X[200], lattice.X.back()});
  exact_on_linear<3>(test::jittered(lattice, 0.5, 5), points(lattice, size, margin, 150));
}

TEST(Sampling, IsExactOnLinearFieldsInThePlane) {
  const Vec3 size(1, 1, 0);
  const auto square = test::box_lattice(9, 11, 1, size);
  exact_on_linear<2>(square, points(square, size, square.spacing / 2, 150));
  exact_on_linear<2>(square, {square.X.front(), square.X[50]});
  exact_on_linear<2>(test::jittered(square, 0.5, 5), points(square, size, 0, 150));
}

TEST(Sampling, DoesNotDependOnTheUnit) {
  auto cloud = test::jittered(test::box_lattice(6, 6, 6, Vec3(1, 1, 1)), 0.3, 2);
  std::vector<Vec3> at = points(cloud, Vec3(1, 1, 1), 0, 50);
  const Sampling metres = build_sampling<3>(at[0], cloud.X, cloud.V);
  for (Vec3& x : cloud.X)
    x *= 1e-6;
  for (double& v : cloud.V)
    v *= 1e-18;
  for (Vec3& x : at)
    x *= 1e-6;
  exact_on_linear<3>(cloud, at, 1e-6);
  const Sampling micrometres = build_sampling<3>(at[0], cloud.X, cloud.V);
  ASSERT_EQ(metres.particle, micrometres.particle);
  for (std::size_t i = 0; i < metres.weight.size(); ++i)
    EXPECT_NEAR(metres.weight[i], micrometres.weight[i], 1e-13);
}

TEST(Sampling, SatisfiesTheCorrectedKernelsOwnEquations) {
  // (3.59) as it is written, beside the weights: alpha, beta of one support.
  const auto cloud = test::jittered(test::box_lattice(7, 7, 7, Vec3(1, 1, 1)), 0.3, 2);
  const Vec3 x(0.02, 0.31, 0.87);
  const Kernel<3> W{KernelShape::quintic};
  const Sampling sampling = build_sampling<3>(x, cloud.X, cloud.V, {}, W);
  Mat3 second = Mat3::Zero();
  Vec3 first = Vec3::Zero();
  for (const std::int32_t b : sampling.particle) {
    const Vec3 R = x - cloud.X[b];
    const double VW = cloud.V[b] * W.value(R.norm(), sampling.support);
    second += VW * R * R.transpose();
    first -= VW * R;
  }
  const Vec3 beta = second.inverse() * first;
  double one_over_alpha = 0;
  const auto uncorrected = [&](std::int32_t b) {
    const Vec3 R = x - cloud.X[b];
    return cloud.V[b] * (1 + beta.dot(R)) * W.value(R.norm(), sampling.support);
  };
  for (const std::int32_t b : sampling.particle)
    one_over_alpha += uncorrected(b);
  for (std::size_t i = 0; i < sampling.particle.size(); ++i)
    EXPECT_NEAR(sampling.weight[i], uncorrected(sampling.particle[i]) / one_over_alpha, 1e-12);
}

TEST(Sampling, ConvergesWithSecondOrder) {
  EXPECT_LT(error<3>(9, 0), 0.03);
  EXPECT_GT(error<3>(9, 0) / error<3>(17, 0), 3.6);
  EXPECT_GT(error<3>(9, 0.3) / error<3>(17, 0.3), 3.3);
  EXPECT_GT(error<2>(17, 0) / error<2>(33, 0), 3.6);
  EXPECT_GT(error<2>(17, 0.3) / error<2>(33, 0.3), 3.3);
}

TEST(Sampling, VectorsAndTensorsComeInOnePiece) {
  const auto cloud = test::box_lattice(5, 5, 5, Vec3(1, 1, 1));
  const Vec3 x(0.3, 0.45, 0.9);
  const Sampling sampling = build_sampling<3>(x, cloud.X, cloud.V);
  const Vec3 position = sampling([&](std::int32_t b) { return cloud.X[b]; });
  EXPECT_LT((position - x).norm(), 1e-14);
  const Mat3 F = sampling([&](std::int32_t b) -> Mat3 { return cloud.X[b][0] * Mat3::Identity(); });
  EXPECT_LT((F - 0.3 * Mat3::Identity()).norm(), 1e-14);
}

TEST(Sampling, PointOutsideTheCloudIsRefusedByName) {
  const auto cloud = test::box_lattice(6, 6, 6, Vec3(1, 1, 1)); // spacing 0.2
  EXPECT_EQ(refusal(Vec3(0.5, 0.5, 1.2), cloud), "");
  const std::string message = refusal(Vec3(0.4, 0.6, 1.4), cloud);
  EXPECT_EQ(message, "the point (0.4, 0.6, 1.4) m lies outside the body: the nearest particle, 200, is 0.4 m "
                     "away, the cloud reaches 0.3536 m there, move it into the body (reference position, m)");
  EXPECT_NE(refusal(Vec3(0.5, NAN, 0.5), cloud), "");
  const auto plane = test::box_lattice(6, 6, 1, Vec3(1, 1, 0));
  EXPECT_NE(refusal(Vec3(0.5, 1.4, 0), plane).find("lies outside the body"), std::string::npos);
  EXPECT_EQ(refusal(Vec3(0.5, 0.5, 7), plane), ""); // z means nothing there
}

TEST(Sampling, ParticlesThatDoNotSpanSpaceAreRefused) {
  auto sheet = test::box_lattice(6, 6, 1, Vec3(1, 1, 0));
  sheet.dimension = 3;
  EXPECT_NE(refusal(Vec3(0.5, 0.5, 0), sheet).find("do not span space within"), std::string::npos);
  std::vector<std::array<std::int32_t, 2>> pairs; // the corner sees nobody
  for (std::int32_t b = 1; b < 36; ++b)
    pairs.push_back({0, b});
  EXPECT_THROW(build_sampling<2>(Vec3(0, 0, 0), sheet.X, sheet.V, HiddenPairs(36, pairs)), InputError);
  auto heap = sheet;
  heap.X.assign(36, Vec3::Ones());
  EXPECT_NE(refusal(Vec3::Ones(), heap).find("do not span space within"), std::string::npos);
  sheet.X.resize(6);
  EXPECT_NE(refusal(Vec3(0.5, 0, 0), sheet).find("more than 6 particles"), std::string::npos);
}

TEST(Sampling, GrowsUntilItSpansSpace) {
  // Layers ten times farther apart than the particles within them.
  const Vec3 size(1, 1, 3);
  const auto layers = test::box_lattice(11, 11, 4, size);
  const Vec3 x(0.52, 0.47, 1.9);
  const Sampling sampling = build_sampling<3>(x, layers.X, layers.V);
  EXPECT_GT(sampling.support, 1);
  EXPECT_LT((sampling([&](std::int32_t b) { return layers.X[b]; }) - x).norm(), 1e-12);
}

TEST(Sampling, LooksAcrossNoSlot) {
  // Left and right of x = 0.5 do not see each other.
  const auto cloud = test::box_lattice(10, 10, 1, Vec3(1, 1, 0));
  std::vector<std::array<std::int32_t, 2>> pairs;
  for (std::int32_t a = 0; a < 100; ++a)
    for (std::int32_t b = a + 1; b < 100; ++b)
      if ((cloud.X[a][0] < 0.5) != (cloud.X[b][0] < 0.5))
        pairs.push_back({a, b});
  const HiddenPairs hidden(100, pairs);
  const auto jump = [&](std::int32_t b) { return cloud.X[b][0] < 0.5 ? 0.0 : 1.0; };
  EXPECT_NEAR(build_sampling<2>(Vec3(0.49, 0.5, 0), cloud.X, cloud.V, hidden)(jump), 0, 1e-14);
  EXPECT_NEAR(build_sampling<2>(Vec3(0.51, 0.5, 0), cloud.X, cloud.V, hidden)(jump), 1, 1e-14);
}

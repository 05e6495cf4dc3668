#include "core/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace tessera;

namespace {

std::vector<Vec3> random_points(int n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 2);
  std::vector<Vec3> X;
  for (int i = 0; i < n; ++i)
    X.emplace_back(uniform(random), uniform(random), 0.1 * uniform(random));
  return X;
}

} // namespace

TEST(Neighbours, AreThoseOfTheBruteForceSearch) {
  const auto X = random_points(400, 1);
  std::mt19937_64 random(2);
  std::vector<double> support;
  for (std::size_t i = 0; i < X.size(); ++i)
    support.push_back(0.05 + 0.4 * static_cast<double>(random() >> 11) * 0x1p-53);
  const Neighbours found = find_neighbours(X, support);
  ASSERT_EQ(found.size(), 400);
  for (int a = 0; a < 400; ++a) {
    std::vector<std::int32_t> expected;
    for (int b = 0; b < 400; ++b)
      if (b != a && (X[a] - X[b]).norm() < std::max(support[a], support[b]))
        expected.push_back(b);
    const std::vector<std::int32_t> got(found.column.begin() + found.row[a],
                                        found.column.begin() + found.row[a + 1]);
    ASSERT_EQ(got, expected) << a;
  }
}

TEST(Neighbours, TwoClustersFarApartDoNotExhaustMemory) {
  auto X = random_points(100, 3);
  for (const Vec3& x : random_points(100, 4))
    X.push_back(x + Vec3(1e9, -1e9, 1e9));
  const Neighbours found = find_neighbours(X, std::vector<double>(X.size(), 0.5));
  for (std::int64_t a = 0; a < 100; ++a)
    for (std::int64_t e = found.row[a]; e < found.row[a + 1]; ++e)
      ASSERT_LT(found.column[e], 100);
}

TEST(Neighbours, DistanceToTheKthNearestIsTheSortedOne) {
  const auto X = random_points(300, 5);
  for (const int k : {1, 7, 30}) {
    const auto distance = distance_to_nearest(X, k);
    for (std::size_t a = 0; a < X.size(); ++a) {
      std::vector<double> all;
      for (std::size_t b = 0; b < X.size(); ++b)
        if (b != a)
          all.push_back((X[a] - X[b]).norm());
      std::sort(all.begin(), all.end());
      ASSERT_EQ(distance[a], all[k - 1]);
    }
  }
}

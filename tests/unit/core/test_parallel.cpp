#include "core/parallel.hpp"

#include "core/tensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

using namespace tessera;

namespace {

class Parallel : public ::testing::Test {
 protected:
  void TearDown() override { set_threads(0); }
};

} // namespace

TEST_F(Parallel, ForEachVisitsEveryItemOnce) {
  for (const int n : {1, 2, 5}) {
    set_threads(n);
    std::vector<int> visits(10007, 0);
    for_each(10007, [&](std::int64_t i) { ++visits[i]; });
    for_each_uneven(10007, [&](std::int64_t i) { ++visits[i]; });
    for (const int v : visits)
      ASSERT_EQ(v, 2);
  }
}

TEST_F(Parallel, SumsAreTheSameBitsOnAnyThreadCount) {
  const auto term = [](std::int64_t i) { return std::sin(static_cast<double>(i)) * std::pow(10.0, i % 17); };
  set_threads(1);
  const double one = sum(100003, 0.0, term);
  const Vec3 one_vector =
      sum(100003, Vec3(Vec3::Zero()), [&](std::int64_t i) -> Vec3 { return Vec3(term(i), i, 1); });
  for (const int n : {2, 3, 7}) {
    set_threads(n);
    EXPECT_EQ(one, sum(100003, 0.0, term));
    EXPECT_EQ(one_vector,
              sum(100003, Vec3(Vec3::Zero()), [&](std::int64_t i) -> Vec3 { return Vec3(term(i), i, 1); }));
  }
  EXPECT_EQ(one_vector[2], 100003);
}

TEST_F(Parallel, ExtremesAreFound) {
  EXPECT_EQ(max_of(5000, 0.0, [](std::int64_t i) { return i == 3777 ? 8.5 : 1.0; }), 8.5);
  EXPECT_EQ(min_of(5000, 0.0, [](std::int64_t i) { return i == 4999 ? -2.5 : 1.0; }), -2.5);
  EXPECT_EQ(min_of(0, 7.0, [](std::int64_t) { return 0.0; }), 7.0);
}

TEST_F(Parallel, TheLowestFailureIsRethrownOnAnyThreadCount) {
  for (const int n : {1, 4}) {
    set_threads(n);
    try {
      for_each(100000, [](std::int64_t i) {
        if (i == 900 || i == 90000)
          throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "900");
    }
  }
}

#include "core/cost.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

namespace tessera {
namespace {

double work(double seconds) {
  double x = 1;
  for (const double start = cpu_seconds(); cpu_seconds() - start < seconds;)
    for (int i = 0; i < 10'000; ++i)
      x = 0.5 * (x + 2 / x);
  return x;
}

TEST(Cost, ProcessorTimeCountsWorkAndNotWaiting) {
  const double start = cpu_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_LT(cpu_seconds() - start, 0.05);
  EXPECT_NEAR(work(0.05), 1.41421356, 1e-6);
  EXPECT_GE(cpu_seconds() - start, 0.05);
}

TEST(Cost, ChildrenCountWhenTheyHaveEnded) {
  const double start = cpu_seconds_of_children();
  ASSERT_EQ(std::system("i=0; while [ $i -lt 20000 ]; do i=$((i + 1)); done"), 0);
  EXPECT_GT(cpu_seconds_of_children(), start);
}

TEST(Cost, PeakMemoryKeepsWhatWasGivenBack) {
  const std::uint64_t before = peak_memory();
  EXPECT_GT(before, 100'000U);
  {
    const std::vector<double> large(8'000'000, 1.0);
    EXPECT_EQ(large.back(), 1.0);
  }
  EXPECT_GE(peak_memory(), before + 40'000'000U);
}

} // namespace
} // namespace tessera

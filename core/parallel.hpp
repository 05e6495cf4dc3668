/// Loops over particles on all threads, with results that do not depend on how many there are.
///
/// Every loop is an owner-computes gather (item i writes only what belongs to i). Sums run in blocks of fixed
/// size whose partial sums are added in order, so one thread and many give the same bits.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <vector>

namespace tessera {

/// Threads used by every loop from now on; n <= 0 means as many as OpenMP offers (OMP_NUM_THREADS, else all
/// cores).
void set_threads(int n);
int threads();

/// Calls f(begin, end) for the blocks of [0, n), in parallel. An exception thrown by f is rethrown here (the
/// one of the lowest block).
template <std::int64_t block = 256, class F>
void for_each_block(std::int64_t n, F&& f) {
  const std::int64_t blocks = (n + block - 1) / block;
  std::exception_ptr failure;
  std::int64_t failed_block = blocks;
#pragma omp parallel for schedule(static) num_threads(threads()) if (blocks > 1)
  for (std::int64_t b = 0; b < blocks; ++b) {
    try {
      f(b * block, std::min(n, (b + 1) * block));
    } catch (...) {
#pragma omp critical(tessera_for_each)
      if (b < failed_block) {
        failed_block = b;
        failure = std::current_exception();
      }
    }
  }
  if (failure)
    std::rethrow_exception(failure);
}

/// Calls f(i) for i in [0, n), in parallel blocks.
template <class F>
void for_each(std::int64_t n, F&& f) {
  for_each_block(n, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
      f(i);
  });
}

/// As for_each, for items of very uneven cost: small blocks (of `together` items) handed out as threads
/// become free.
template <int together = 16, class F>
void for_each_uneven(std::int64_t n, F&& f) {
  std::exception_ptr failure;
  std::int64_t failed = n;
#pragma omp parallel for schedule(dynamic, together) num_threads(threads()) if (n > together)
  for (std::int64_t i = 0; i < n; ++i) {
    try {
      f(i);
    } catch (...) {
#pragma omp critical(tessera_for_each)
      if (i < failed) {
        failed = i;
        failure = std::current_exception();
      }
    }
  }
  if (failure)
    std::rethrow_exception(failure);
}

/// As for_each, for few items of much work each, handed out one by one.
template <class F>
void for_each_task(std::int64_t n, F&& f) {
  for_each_uneven<1>(n, f);
}

/// Combines f(0) ... f(n-1) by `combine` in fixed blocks of 1024 from `first`: same bits on any thread count.
template <class T, class F, class Combine>
T reduce(std::int64_t n, T first, F&& f, Combine&& combine) {
  constexpr std::int64_t block = 1024;
  const std::int64_t blocks = (n + block - 1) / block;
  std::vector<T> partial(static_cast<std::size_t>(blocks), first);
#pragma omp parallel for schedule(static) num_threads(threads()) if (blocks > 1)
  for (std::int64_t b = 0; b < blocks; ++b) {
    T sum = first;
    for (std::int64_t i = b * block; i < std::min(n, (b + 1) * block); ++i)
      sum = combine(sum, f(i));
    partial[static_cast<std::size_t>(b)] = sum;
  }
  T total = first;
  for (const T& part : partial)
    total = combine(total, part);
  return total;
}

/// Sum of f(i) (a number or an Eigen vector) starting from `zero`.
template <class T, class F>
T sum(std::int64_t n, T zero, F&& f) {
  return reduce(n, zero, f, [](const T& a, const T& b) -> T { return a + b; });
}

template <class F>
double max_of(std::int64_t n, double first, F&& f) {
  return reduce(n, first, f, [](double a, double b) { return std::max(a, b); });
}

template <class F>
double min_of(std::int64_t n, double first, F&& f) {
  return reduce(n, first, f, [](double a, double b) { return std::min(a, b); });
}

} // namespace tessera

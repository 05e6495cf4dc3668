#include "core/parallel.hpp"

#include <omp.h>

namespace tessera {
namespace {

int thread_count = 0;

} // namespace

void set_threads(int n) {
  thread_count = n;
}

int threads() {
  return thread_count > 0 ? thread_count : omp_get_max_threads();
}

} // namespace tessera

#include "app/waiting_threads.hpp"

#include <cstdlib>

#include <unistd.h>

namespace tessera::app {

void let_waiting_threads_sleep(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr)
    return;
  if (::setenv("OMP_WAIT_POLICY", "passive", 1) == 0)
    ::execv("/proc/self/exe", argv);
}

} // namespace tessera::app

#include "app/short_spins.hpp"

#include <cstdlib>

#include <unistd.h>

namespace tessera::app {

void spin_shortly(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr)
    return;
  if (::setenv("GOMP_SPINCOUNT", "2000", 1) == 0)
    ::execv("/proc/self/exe", argv);
}

} // namespace tessera::app

#include "solver/operators/kernel.hpp"

#include "core/error.hpp"

#include <fmt/ranges.h>

#include <algorithm>

namespace tessera::solver {

const std::vector<std::string>& kernel_names() {
  static const std::vector<std::string> names = {"wendland", "cubic", "quartic", "quintic", "gaussian"};
  return names;
}

KernelShape kernel_named(const std::string& name) {
  const auto& names = kernel_names();
  const auto found = std::find(names.begin(), names.end(), name);
  require(found != names.end(), fmt::format("there is no kernel \"{}\"", name), "solver.kernel",
          fmt::format("use one of {}", fmt::join(names, ", ")));
  return static_cast<KernelShape>(found - names.begin());
}

} // namespace tessera::solver

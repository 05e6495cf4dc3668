/// The laws a case can name: their parameters and where they come from, for reading, checking and telling.
#pragma once

#include <string>
#include <vector>

namespace tessera::solver {

struct LawParameter {
  std::string key;
  std::string unit; ///< "-" where it has none
  std::string meaning;
  bool list = false; ///< one number or a list of them
};

struct LawDescription {
  std::string name; ///< as in material.law
  std::string what;
  std::string energy; ///< stored energy per reference volume
  std::string source; ///< equations of the thesis, or whose law it is
  std::vector<LawParameter> parameters;
  bool plasticity = false; ///< whether [material.plasticity] may stand beside it
};

/// How a law that flows hardens.
struct HardeningDescription {
  std::string what;
  std::string yield_stress; ///< of the equivalent plastic strain eps
  std::string source;
  std::vector<LawParameter> parameters; ///< of [material.plasticity]
};

/// Hencky first, then from the simplest on.
const std::vector<LawDescription>& law_catalogue();

const std::vector<HardeningDescription>& hardening_catalogue();

/// Names of the catalogue in its order.
std::vector<std::string> law_names();

/// Null where there is no such law.
const LawDescription* find_law(const std::string& name);

} // namespace tessera::solver

/// A formula of the reference position and the time, as cases write it: "10*Z/6", "sin(_pi*X/2)",
/// "-10*min(t/1e-3,1)".
#pragma once

#include "core/tensor.hpp"

#include <array>
#include <memory>
#include <string>

namespace tessera::solver {

/// Variables X, Y, Z in metres and t in seconds; constants _pi and _e; muParser's functions. Copies share one
/// parsed formula, so one object must not be evaluated from several threads at once.
class Expression {
 public:
  /// Parses and tries the formula; InputError with the position of the fault. `place`: where it is written,
  /// for the message when its value makes no sense.
  explicit Expression(const std::string& formula, std::string place = "");

  double operator()(const Vec3& X, double t = 0) const;
  /// Whether it says the same at every position.
  bool uniform() const;
  const std::string& formula() const { return formula_; }

 private:
  struct Parser;
  std::shared_ptr<Parser> parser_;
  std::string formula_, place_;
};

/// Components of a vector.
using Formulas = std::array<Expression, 3>;

} // namespace tessera::solver

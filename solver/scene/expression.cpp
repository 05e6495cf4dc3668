#include "solver/scene/expression.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>
#include <utility>

namespace tessera::solver {

struct Expression::Parser {
  double X = 0, Y = 0, Z = 0, t = 0;
  mu::Parser parser;
};

Expression::Expression(const std::string& formula, std::string place)
    : parser_(std::make_shared<Parser>()), formula_(formula), place_(std::move(place)) {
  try {
    parser_->parser.DefineVar("X", &parser_->X);
    parser_->parser.DefineVar("Y", &parser_->Y);
    parser_->parser.DefineVar("Z", &parser_->Z);
    parser_->parser.DefineVar("t", &parser_->t);
    parser_->parser.SetExpr(formula);
    parser_->parser.Eval();
  } catch (const mu::Parser::exception_type& error) {
    throw InputError(
        fmt::format("the formula \"{}\" cannot be read at position {}", formula, error.GetPos() + 1), "",
        "check the names and signs there");
  }
}

bool Expression::uniform() const {
  const auto& used = parser_->parser.GetUsedVar();
  return !used.contains("X") && !used.contains("Y") && !used.contains("Z");
}

double Expression::operator()(const Vec3& X, double t) const {
  parser_->X = X[0];
  parser_->Y = X[1];
  parser_->Z = X[2];
  parser_->t = t;
  const double value = parser_->parser.Eval();
  if (!std::isfinite(value))
    throw InputError(fmt::format("the formula \"{}\" is {} at ({:g}, {:g}, {:g}) m, {:g} s", formula_, value,
                                 X[0], X[1], X[2], t),
                     place_, "formulas must be finite at every particle and time they apply to");
  return value;
}

} // namespace tessera::solver

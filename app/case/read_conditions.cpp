#include "app/case/read_conditions.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace tessera::app {
namespace {

using solver::Expression;
using solver::Formulas;
using Kind = solver::BoundaryCondition::Kind;

/// v = omega x (X - centre) as formulas.
std::array<std::string, 3> spin_formulas(const Vec3& omega, const Vec3& centre) {
  const char* const name[] = {"X", "Y", "Z"};
  std::array<std::string, 3> formulas;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    formulas[static_cast<std::size_t>(i)] = fmt::format("({})*({}-({}))-({})*({}-({}))", omega[j], name[k],
                                                        centre[k], omega[k], name[j], centre[j]);
  }
  return formulas;
}

Expression parse(const Table& table, const std::string& key, const std::string& place,
                 const std::string& formula) {
  try {
    return Expression(formula, fmt::format("{}, {}", table.path_of(place), table.place_of(place)));
  } catch (const InputError& e) {
    table.refuse(
        place, fmt::format("{}: {}", table.path_of(key), e.what()),
        "a formula may use X, Y, Z (metres), t (seconds), _pi, _e and functions such as sin, sqrt, min");
  }
}

Formulas parse(const Table& table, const std::string& key, const std::array<std::string, 3>& formulas) {
  const auto one = [&](std::size_t i) {
    return parse(table, key, fmt::format("{}.{}", key, i), formulas[i]);
  };
  return {one(0), one(1), one(2)};
}

std::vector<Expression> parse_vector(Table& table, const std::string& key) {
  const Formulas formulas = parse(table, key, table.formulas(key));
  return {formulas.begin(), formulas.end()};
}

std::array<bool, 3> components_in(const std::vector<std::string>& names) {
  std::array<bool, 3> component;
  for (std::size_t i = 0; i < 3; ++i)
    component[i] = std::find(names.begin(), names.end(), std::string(1, "xyz"[i])) != names.end();
  return component;
}

} // namespace

solver::InitialCondition read_initial(Table initial) {
  solver::InitialCondition condition;
  condition.on = initial.text_or("on", "all");
  auto velocity = initial.optional_formulas("velocity");
  const auto displacement = initial.optional_formulas("displacement");
  auto spin = initial.optional_table("spin");
  Vec3 omega = Vec3::Zero(), centre = Vec3::Zero();
  if (spin) {
    omega = spin->vector("omega");
    centre = spin->vector("centre");
    spin->finish();
  }
  initial.finish();
  const bool both = velocity && spin;
  if (both || !(velocity || spin || displacement))
    throw InputError(
        fmt::format("an [[initial]] entry has {}", both ? "both velocity and spin" : "nothing to set"),
        initial.where(),
        "give velocity = [..] or spin = {omega = [..], centre = [..]}, displacement = [..], or one of each "
        "kind");
  if (spin)
    velocity = spin_formulas(omega, centre);
  if (velocity)
    condition.velocity = parse(initial, "velocity", *velocity);
  if (displacement)
    condition.displacement = parse(initial, "displacement", *displacement);
  return condition;
}

solver::BoundaryCondition read_boundary(Table boundary) {
  static const std::vector<std::pair<std::string, Kind>> kinds = {
      {"clamped", Kind::fixed},     {"fixed", Kind::fixed},
      {"sliding", Kind::sliding},   {"skew_symmetric", Kind::skew_symmetric},
      {"velocity", Kind::velocity}, {"traction", Kind::traction},
      {"pressure", Kind::pressure}, {"body_force", Kind::body_force}};
  std::vector<std::string> names;
  for (const auto& [name, kind] : kinds)
    names.push_back(name);
  const std::string type = boundary.choice("type", names);
  solver::BoundaryCondition condition;
  condition.kind =
      kinds[static_cast<std::size_t>(std::find(names.begin(), names.end(), type) - names.begin())].second;
  condition.on = type == "body_force" ? boundary.text_or("on", "all") : boundary.text("on");
  const std::vector<std::string> xyz = {"x", "y", "z"};
  if (type == "fixed")
    condition.component = components_in(boundary.choices("components", xyz));
  if (type == "velocity") {
    condition.values = parse_vector(boundary, "velocity");
    if (boundary.has("components"))
      condition.component = components_in(boundary.choices("components", xyz));
    else
      boundary.allow("components");
  }
  if (type == "traction")
    condition.values = parse_vector(boundary, "traction");
  if (type == "body_force")
    condition.values = parse_vector(boundary, "acceleration");
  if (type == "pressure")
    condition.values = {parse(boundary, "pressure", "pressure", boundary.formula("pressure"))};
  boundary.finish();
  return condition;
}

solver::ExactSolution read_exact(Table exact) {
  solver::ExactSolution solution;
  if (const auto formulas = exact.optional_formulas("displacement"))
    solution.displacement = parse(exact, "displacement", *formulas);
  if (const auto formulas = exact.optional_formulas("velocity"))
    solution.velocity = parse(exact, "velocity", *formulas);
  if (exact.has("pressure"))
    solution.pressure = parse(exact, "pressure", "pressure", exact.formula("pressure"));
  else
    exact.allow("pressure");
  exact.finish();
  if (!solution.displacement && !solution.velocity && !solution.pressure)
    exact.refuse("", "[exact] gives no field to compare with", "give displacement, velocity or pressure");
  return solution;
}

} // namespace tessera::app

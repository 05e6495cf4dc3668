#include "core/error.hpp"
#include "solver/operators/kernel.hpp"
#include "solver/physics/derived_fields.hpp"
#include "solver/physics/materials/catalogue.hpp"
#include "solver/scene/probe_values.hpp"
#include "solver/scene/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace tessera::solver {
namespace {

void one_of(const std::string& value, const std::vector<std::string>& allowed, const std::string& key,
            const std::string& where) {
  if (std::find(allowed.begin(), allowed.end(), value) != allowed.end())
    return;
  const std::string nearest = nearest_name(value, allowed);
  throw InputError(fmt::format("{} is \"{}\"", key, value), where,
                   fmt::format("{}this version offers: {}",
                               nearest.empty() ? "" : fmt::format("did you mean \"{}\"? ", nearest),
                               fmt::join(allowed, ", ")));
}

using Where = std::function<std::string(const std::string&)>;

void require_number(const std::string& key, double value, bool good, const std::string& range,
                    const Where& where) {
  require(std::isfinite(value) && good, fmt::format("{} is {:g}", key, value), where(key),
          "it must be " + range);
}

/// The constants the law goes by; the others are not looked at.
void validate_constants(const MaterialSpec& m, const Where& where) {
  const auto positive = [&](const std::string& key, double value) {
    require_number(key, value, value > 0, "positive (Pa)", where);
  };
  if (m.law == "mooney_rivlin") {
    for (const auto& [key, value] : {std::pair{"material.c1", m.c1}, {"material.c2", m.c2}})
      require_number(key, value, value >= 0, "zero or positive (Pa)", where);
    require(m.c1 + m.c2 > 0, "material.c1 and material.c2 are both zero", where("material.c1"),
            "the shear modulus 2 (c1 + c2) must be positive");
    positive("material.bulk", m.bulk);
  } else if (m.law == "ogden") {
    require(!m.mu.empty() && m.mu.size() == m.alpha.size(),
            fmt::format("material.mu lists {} and material.alpha {} numbers", m.mu.size(), m.alpha.size()),
            where("material.mu"), "give both one number a term");
    for (std::size_t p = 0; p < m.mu.size(); ++p) {
      const double product = m.mu[p] * m.alpha[p];
      require(std::isfinite(product) && product > 0,
              fmt::format("material.mu and material.alpha are {:g} and {:g} in term {}", m.mu[p], m.alpha[p],
                          p + 1),
              where(fmt::format("material.mu.{}", p)),
              "their product must be positive: both above zero or both below");
    }
    positive("material.bulk", m.bulk);
  } else {
    positive("material.young", m.young);
    require_number("material.poisson", m.poisson, m.poisson > -1 && m.poisson < 0.5,
                   "above -1 and below 0.5: at 0.5 pressure waves are infinitely fast", where);
  }
}

void validate_dissipation(const SceneSpec& scene,
                          const std::function<std::string(const std::string&)>& where) {
  one_of(scene.dissipation, {"auto", "jst", "jst_symmetric", "linear_residual"}, "solver.dissipation",
         where("solver.dissipation"));
  const auto ramp = [&](const std::string& key, const std::optional<PlasticRamp>& value, double most) {
    if (!value)
      return;
    for (double kappa : {value->elastic, value->plastic})
      require_number(key, kappa, kappa >= 0 && kappa <= most, fmt::format("from 0 to {:g}", most), where);
    require_number(fmt::format("{}.strain", key), value->strain, value->strain > 0, "positive", where);
  };
  ramp("solver.jst4", scene.jst4, 1);
  ramp("solver.residual", scene.residual, 4);
  require_number("solver.jst2", scene.jst2, scene.jst2 >= 0 && scene.jst2 <= 2, "from 0 to 2", where);
}

} // namespace

std::vector<std::string> resting_constants(const SceneSpec& scene) {
  const std::string chosen = chosen_dissipation(scene);
  const bool of_jst = chosen != "linear_residual", shocks = chosen == "jst";
  std::vector<std::string> resting;
  const auto note = [&](const char* key, bool given, bool used) {
    if (given && !used)
      resting.push_back(key);
  };
  note("jst4", scene.jst4.has_value(), of_jst);
  note("jst4_J", scene.jst4_J.has_value(), of_jst);
  note("jst2", scene.jst2 != 0, shocks);
  note("residual", scene.residual.has_value(), !of_jst);
  note("residual_J", scene.residual_J.has_value(), !of_jst);
  return resting;
}

void validate(const SceneSpec& scene, const std::function<std::string(const std::string&)>& where) {
  const auto number = [&](const std::string& key, double value, bool good, const std::string& range) {
    require_number(key, value, good, range, where);
  };
  const auto name = [&](const std::string& key, const std::string& value,
                        const std::vector<std::string>& allowed) { one_of(value, allowed, key, where(key)); };

  const MaterialSpec& m = scene.material;
  name("material.law", m.law, law_names());
  number("material.density", m.density, m.density > 0, "positive (kg/m^3)");
  validate_constants(m, where);
  if (m.plasticity) {
    require(find_law(m.law)->plasticity,
            fmt::format("material.plasticity stands beside the law \"{}\", which is elastic only", m.law),
            where("material.plasticity"), "use law = \"hencky\", or leave the table out");
    if (const auto* linear = std::get_if<LinearHardening>(&*m.plasticity)) {
      number("material.plasticity.yield", linear->yield, linear->yield > 0, "positive (Pa)");
      number("material.plasticity.hardening", linear->modulus, linear->modulus >= 0, "zero or positive (Pa)");
    } else {
      const auto& power = std::get<PowerHardening>(*m.plasticity);
      number("material.plasticity.power.coefficient", power.coefficient, power.coefficient > 0,
             "positive (Pa)");
      number("material.plasticity.power.offset", power.offset, power.offset > 0, "positive");
      number("material.plasticity.power.exponent", power.exponent, power.exponent >= 0 && power.exponent <= 1,
             "from 0 to 1");
    }
  }

  name("solver.formulation", scene.formulation, {"auto", "displacement", "pF", "pFJ", "pFHJ"});
  name("solver.scheme", scene.scheme, {"thesis", "consistent"});
  name("solver.kernel", scene.kernel, kernel_names());
  if (scene.support)
    number("solver.support", *scene.support, *scene.support > 1 && *scene.support <= 6,
           "above 1 and at most 6 (kernel radius over the spacing)");
  number("solver.neighbours", scene.neighbours,
         scene.neighbours == 0 || (scene.neighbours >= 8 && scene.neighbours <= 200), "from 8 to 200");
  validate_dissipation(scene, where);
  const std::string formulation = chosen_formulation(scene);
  const bool evolves_J = formulation == "pFJ" || formulation == "pFHJ";
  const auto only_with_J = [&](const std::string& key, const std::optional<double>& value, double most) {
    if (!value)
      return;
    require(
        evolves_J,
        fmt::format("{} is given, but the formulation is \"{}\", which does not evolve J", key, formulation),
        where(key), "leave it out, or choose \"pFJ\" or \"pFHJ\"");
    number(key, *value, *value >= 0 && *value <= most, fmt::format("from 0 to {:g}", most));
  };
  only_with_J("solver.jst4_J", scene.jst4_J, 1);
  only_with_J("solver.residual_J", scene.residual_J, 4);
  only_with_J("solver.involution", scene.involution, 4);
  name("solver.integrator", scene.integrator, {"auto", "heun", "verlet"});
  if (scene.cfl)
    number("solver.cfl", *scene.cfl, *scene.cfl > 0 && *scene.cfl <= 1, "above 0 and at most 1");
  number("solver.end_time", scene.end_time, scene.end_time > 0, "positive (s)");

  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const WallSpec& wall = scene.walls[i];
    number(fmt::format("wall.{}.friction", i), wall.friction, wall.friction >= 0, "zero or positive");
    number(fmt::format("wall.{}.restitution", i), wall.restitution,
           wall.restitution >= 0 && wall.restitution <= 1, "from 0 to 1");
    number(fmt::format("wall.{}.stiffness", i), wall.stiffness, wall.stiffness > 0 && wall.stiffness <= 10,
           "above 0 and at most 10: a stiffer one needs smaller steps than the body does");
    number(fmt::format("wall.{}.velocity", i), wall.velocity.norm(), wall.velocity.allFinite(),
           "three numbers (m/s)");
  }
  for (std::size_t i = 0; i < scene.boundary.size(); ++i) {
    const auto& c = scene.boundary[i].component;
    require(c[0] || c[1] || c[2], "no component is held", where(fmt::format("boundary.{}.components", i)),
            "name at least one of \"x\", \"y\", \"z\"");
  }

  std::set<std::string> seen;
  for (std::size_t i = 0; i < scene.probes.size(); ++i) {
    const Probe& probe = scene.probes[i];
    const std::string key = fmt::format("output.probe.{}", i);
    name(key + ".quantity", probe.quantity, probe_quantities());
    if (!probe.at)
      name(key + ".reduce", probe.reduce, probe_reductions());
    require(seen.insert(column_name(probe)).second, fmt::format("two probes are named '{}'", probe.name),
            where(key + ".name"), "give each its own name");
  }
  for (std::size_t i = 0; i < scene.fields.size(); ++i)
    one_of(scene.fields[i], derived_field_names(), "output.fields",
           where(fmt::format("output.fields.{}", i)));
  number("output.frames", scene.frames, scene.frames >= 1 && scene.frames <= 100000, "from 1 to 100000");
  number("output.history_rows", scene.history_rows, scene.history_rows >= 1 && scene.history_rows <= 10000000,
         "from 1 to 10000000");
}

} // namespace tessera::solver

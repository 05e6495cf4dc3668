#include "app/study/plan.hpp"

#include "app/case/case.hpp"
#include "app/study/content_hash.hpp"
#include "app/study/grid.hpp"
#include "core/error.hpp"
#include "core/particle_cloud.hpp"
#include "solver/scene/probe_values.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;

std::string key_of(const std::string& assignment) {
  return assignment.substr(0, assignment.find('='));
}

/// What the command line sets must not be set again by an axis.
void refuse_contradictions(const Study& study, const std::vector<std::string>& overrides) {
  for (const std::string& override_ : overrides)
    for (const Axis& axis : study.axes)
      for (const AxisValue& value : axis.values)
        for (const std::string& assignment : value.assignments)
          require(key_of(assignment) != key_of(override_),
                  fmt::format("axis '{}' of the study sets {}", axis.name, key_of(override_)),
                  "--set " + override_, "leave it out, or change the study");
}

fs::path required_file(const preprocess::GeometrySource& source, const Case& the_case,
                       const std::string& key) {
  std::error_code failed;
  require(fs::is_regular_file(source.file, failed),
          fmt::format("there is no CAD file {}", source.file.string()), the_case.where(key),
          "paths are relative to the case file");
  return source.file;
}

/// The case, what it reads and who runs it.
std::string id_of(const Case& the_case) {
  ContentHash hash;
  hash.add(TESSERA_VERSION);
  hash.add(the_case.text);
  if (!the_case.geometry.shape)
    hash.add_file(required_file(the_case.geometry, the_case, "geometry.file"));
  for (const WallSurface& surface : the_case.wall_surfaces)
    if (!surface.source.shape)
      hash.add_file(
          required_file(surface.source, the_case, fmt::format("wall.{}.surface.file", surface.entry)));
  return hash.text();
}

/// In proportion to particles times steps, with what Heun's method takes above Störmer and Verlet's; bodies
/// are taken to be all of one volume.
double work_of(const Case& the_case) {
  const double d = the_case.geometry.dimension;
  const preprocess::ParticleRequest& particles = the_case.particles;
  const double n =
      particles.count > 0 ? static_cast<double>(particles.count) : std::pow(particles.spacing, -d);
  constexpr double heun = 5; // two evaluations a step, and shorter steps
  return the_case.scene.end_time * std::pow(n, 1 + 1 / d) *
         (solver::chosen_integrator(the_case.scene) == "heun" ? heun : 1);
}

void require_closed_form(const Case& the_case, const std::string& field) {
  const auto& exact = the_case.scene.exact;
  const bool given = exact && (field == "velocity"   ? exact->velocity.has_value()
                               : field == "pressure" ? exact->pressure.has_value()
                                                     : exact->displacement.has_value());
  require(given, fmt::format("the case has no closed form of the {}", field), the_case.path.string(),
          fmt::format("add {} to its [exact], or measure the error otherwise", field));
}

std::string probe_column(const Case& the_case, const std::string& name) {
  std::vector<std::string> names;
  for (const solver::Probe& probe : the_case.scene.probes) {
    if (probe.name == name)
      return solver::column_name(probe);
    names.push_back(probe.name);
  }
  const std::string nearest = nearest_name(name, names);
  throw InputError(fmt::format("the case has no probe '{}'", name), the_case.path.string(),
                   fmt::format("{}its probes: {}",
                               nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest),
                               names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
}

/// Reads one case of the study and checks that it can be measured.
PlannedRun plan_run(const Study& study, const std::vector<std::string>& assignments, const std::string& words,
                    std::string& column) {
  try {
    const Case the_case = read_case(study.case_file, assignments);
    the_case.require_scene();
    if (study.error.of == ErrorMeasure::Of::closed_form)
      require_closed_form(the_case, study.error.name);
    if (study.error.of == ErrorMeasure::Of::probe)
      column = probe_column(the_case, study.error.name);
    return {{}, words, id_of(the_case), the_case.text, work_of(the_case)};
  } catch (const InputError& e) {
    throw InputError(fmt::format("{} ({}): {}", study.path.string(), words, e.what()), "", "");
  }
}

} // namespace

Plan plan_study(const Study& study, const std::vector<std::string>& overrides) {
  refuse_contradictions(study, overrides);
  // A run's frames are of no use here but the last, which fields are measured in.
  std::vector<std::string> common{"output.frames=1"};
  common.insert(common.end(), study.common.begin(), study.common.end());
  common.insert(common.end(), overrides.begin(), overrides.end());
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = common;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  Plan plan;
  for (const GridPoint& point : expand_grid(study)) {
    plan.runs.push_back(plan_run(study, with(point.assignments),
                                 fmt::format("{}", fmt::join(point.labels, ", ")), plan.column));
    plan.runs.back().labels = point.labels;
  }
  if (study.error.finer)
    plan.finer = plan_run(study, with(*study.error.finer), "the finer run", plan.column);
  return plan;
}

} // namespace tessera::app

#include "app/summary.hpp"

#include "app/json_text.hpp"
#include "core/cost.hpp"
#include "core/parallel.hpp"

namespace tessera::app {
namespace {

/// Of the fields the closed form gives.
Json error_json(const solver::ExactSolution& exact, const solver::ErrorNorms& error) {
  Json json;
  if (exact.displacement) {
    json["l1_displacement"] = error.l1_displacement;
    json["l2_displacement"] = error.l2_displacement;
    json["l2_displacement_relative"] = error.l2_displacement_relative;
  }
  if (exact.velocity) {
    json["l1_velocity"] = error.l1_velocity;
    json["l2_velocity"] = error.l2_velocity;
    json["l2_velocity_relative"] = error.l2_velocity_relative;
    json["l2_velocity_thesis"] = error.l2_velocity_thesis;
  }
  if (exact.pressure) {
    json["l1_pressure"] = error.l1_pressure;
    json["l2_pressure"] = error.l2_pressure;
    json["l2_pressure_relative"] = error.l2_pressure_relative;
  }
  return json;
}

} // namespace

std::string summary_json(const Case& the_case, const ParticleCloud& cloud, const solver::Summary& s) {
  Json json;
  json["case"] = the_case.name;
  json["title"] = the_case.title;
  json["version"] = TESSERA_VERSION;
  json["formulation"] = s.formulation;
  json["scheme"] = s.scheme;
  json["dissipation"] = s.dissipation;
  json["arrangement"] = cloud.arrangement;
  json["subvolumes"] = cloud.subvolumes;
  json["seed"] = cloud.seed;
  json["dimension"] = cloud.dimension;
  json["particles"] = s.particles;
  json["neighbours_mean"] = s.neighbours_mean;
  json["support"] = s.support;
  json["spacing"] = cloud.spacing;
  json["steps"] = s.steps;
  json["time"] = s.time;
  json["dt_min"] = s.dt_min;
  json["dt_max"] = s.dt_max;
  json["step"] = step_json(s.step);
  json["wall_seconds"] = s.wall_seconds;
  json["us_per_particle_step"] = s.us_per_particle_step;
  json["cpu_seconds"] = s.cpu_seconds;
  json["setup_seconds"] = s.setup_seconds;
  json["peak_bytes"] = peak_memory();
  json["threads"] = s.threads;
  json["bytes_per_particle"] = s.bytes_per_particle;
  json["volume_sum"] =
      sum(cloud.size(), 0.0, [&](std::int64_t a) { return cloud.V[static_cast<std::size_t>(a)]; });
  json["energy"] = {{"kinetic", s.energy.kinetic},   {"internal", s.energy.internal},
                    {"plastic", s.energy.plastic},   {"dissipated", s.energy.dissipated},
                    {"external", s.energy.external}, {"balance_error", s.energy.balance_error}};
  json["momentum"] = {{"linear_drift", s.linear_drift}, {"angular_drift", s.angular_drift}};
  json["max"] = {{"equivalent_plastic_strain", s.extremes.equivalent_plastic_strain},
                 {"von_mises", s.extremes.von_mises},
                 {"pressure", s.extremes.pressure},
                 {"displacement", s.extremes.displacement}};
  json["min"] = {{"pressure", s.extremes.smallest_pressure}, {"jacobian", s.extremes.jacobian}};
  json["extent_min"] = list(s.extent_min);
  json["extent_max"] = list(s.extent_max);
  json["probes"] = Json::object();
  for (const auto& [name, value] : s.probes)
    json["probes"][name] = value;
  if (s.error)
    json["error"] = error_json(*the_case.scene.exact, *s.error);
  return print(json);
}

} // namespace tessera::app

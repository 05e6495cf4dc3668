#include "app/summary.hpp"

#include "core/cost.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace tessera::app {
namespace {

using Json = nlohmann::ordered_json;

Json list(const Vec3& x) {
  return Json::array({x[0], x[1], x[2]});
}

std::string words(const std::vector<std::string>& list) {
  return list.empty() ? "nothing" : fmt::format("{}", fmt::join(list, ", "));
}

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

/// Names come from files and may not be UTF-8; a result must not be lost over one.
std::string print(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json step_json(const solver::StepChoice& step) {
  return {{"by_wave", step.by_wave}, {"critical", step.critical}, {"bound", step.bound}};
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

std::string outlook_json(const Case& the_case, const Outlook& o) {
  Json json;
  json["case"] = the_case.name;
  json["title"] = the_case.title;
  json["version"] = TESSERA_VERSION;
  json["geometry"] = the_case.geometry_text();
  json["dimension"] = o.quality.dimension;
  json["lower"] = list(o.lower);
  json["upper"] = list(o.upper);
  json["cad_volume"] = o.quality.cad_volume;
  json["domain_volume"] = o.quality.domain_volume;
  json["volume_error"] = o.quality.volume_error;
  json["particles"] = o.quality.particles;
  json["spacing"] = o.spacing;
  json["sets"] = o.sets;
  if (o.forecast) {
    const solver::Forecast& f = *o.forecast;
    json["mass"] = f.mass;
    json["wave_speed"] = f.wave_speed;
    json["dt"] = f.dt;
    json["step"] = step_json(f.step);
    json["steps"] = f.steps;
    json["neighbours_mean"] = f.neighbours_mean;
    json["bytes_per_particle"] = f.bytes_per_particle;
    json["bytes_by_formulation"] = Json::object();
    for (const auto& [name, bytes] : f.bytes_by_formulation)
      json["bytes_by_formulation"][name] = bytes;
    json["seconds"] = f.seconds;
    json["modelled"] = f.modelled;
    json["left_out"] = f.left_out;
  }
  return print(json);
}

std::string outlook_text(const Case& the_case, const Outlook& o) {
  const Vec3 size = o.upper - o.lower;
  std::string text = the_case.title + "\n";
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<14}{}\n", what, value);
  };
  line("geometry", the_case.geometry_text());
  line("bounding box", fmt::format("{:.6g} x {:.6g} x {:.6g} m, from ({:.6g}, {:.6g}, {:.6g}) m", size[0],
                                   size[1], size[2], o.lower[0], o.lower[1], o.lower[2]));
  if (o.quality.dimension == 2)
    line("area", fmt::format("{:.6g} m^2 (CAD {:.6g} m^2), plane strain", o.quality.domain_volume,
                             o.quality.cad_volume));
  else
    line("volume", fmt::format("{:.6g} m^3 (CAD {:.6g} m^3)", o.quality.domain_volume, o.quality.cad_volume));
  line("particles", fmt::format("{}, spacing {:.4g} m", o.quality.particles, o.spacing));
  line("sets", o.sets.empty() ? "none" : words(o.sets));
  if (!o.forecast)
    return text;
  const solver::Forecast& f = *o.forecast;
  line("neighbours", fmt::format("{:.1f} each", f.neighbours_mean));
  line("modelled", words(f.modelled));
  line("left out", words(f.left_out));
  line("mass", fmt::format("{:.6g} kg", f.mass));
  line("wave speed", fmt::format("{:.6g} m/s", f.wave_speed));
  line("time step",
       fmt::format("{:.4g} s: at least {} steps to {:.4g} s", f.dt, f.steps, the_case.scene.end_time));
  line("", fmt::format("{:.3g} of the {:.4g} s a wave takes to the nearest particle (3.93), {:.3g} of the "
                       "critical {:.4g} s{}",
                       f.dt / f.step.by_wave, f.step.by_wave, f.dt / f.step.critical, f.step.critical,
                       f.step.bound == "critical" ? ", which binds" : ": the first binds"));
  line("memory", fmt::format("{:.1f} MB ({:.0f} bytes a particle)",
                             f.bytes_per_particle * static_cast<double>(o.quality.particles) / 1e6,
                             f.bytes_per_particle));
  std::string others;
  for (const auto& [name, bytes] : f.bytes_by_formulation)
    others += fmt::format("{}{} {:.0f}", others.empty() ? "" : ", ", name, bytes);
  line("", fmt::format("bytes a particle by formulation: {}", others));
  line("time", fmt::format("at least {} on {} thread{}: a body that is compressed takes more steps",
                           duration(f.seconds), threads(), threads() == 1 ? "" : "s"));
  return text;
}

} // namespace tessera::app

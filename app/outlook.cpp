#include "app/outlook.hpp"

#include "app/json_text.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace tessera::app {
namespace {

Json reasoned_json(const std::vector<solver::Reasoned>& list) {
  Json json = Json::array();
  for (const solver::Reasoned& entry : list)
    json.push_back({{"what", entry.what}, {"why", entry.why}});
  return json;
}

Json rehearsals_json(const Rehearsal& rehearsal) {
  Json json = Json::array();
  for (const Rehearsed& run : rehearsal.runs) {
    json.push_back({{"particles", run.particles},
                    {"slowing", run.slowing},
                    {"costlier", run.costlier},
                    {"reached", run.reached},
                    {"cpu_seconds", run.cpu_seconds},
                    {"heavier", run.heavier}});
    if (!run.broken_down.empty())
      json.back()["broken_down"] = run.broken_down;
  }
  return json;
}

/// Lines of a report: a heading in front, its continuation indented.
class Lines {
 public:
  explicit Lines(const std::string& title) : text_(title + "\n") {}

  void add(const char* what, const std::string& value) { text_ += fmt::format("  {:<14}{}\n", what, value); }
  void add(const char* what, const std::vector<solver::Reasoned>& list) {
    for (const solver::Reasoned& entry : list) {
      add(what, fmt::format("{} ({})", entry.what, entry.why));
      what = "";
    }
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void tell_time(const Case& the_case, const Outlook& o, Lines& lines) {
  const solver::Forecast& f = *o.forecast;
  const Expectation e = expected(the_case, o);
  lines.add("time step",
            fmt::format("{:.4g} s at first: {} steps to {:.4g} s", f.dt, e.steps, the_case.scene.end_time));
  lines.add("",
            fmt::format("{:.3g} of the {:.4g} s a wave takes to the nearest particle (3.93), {:.3g} of the "
                        "critical {:.4g} s{}",
                        f.dt / f.step.by_wave, f.step.by_wave, f.dt / f.step.critical, f.step.critical,
                        f.step.bound == "critical" ? ", which binds" : ": the first binds"));
  std::string tried;
  for (const Rehearsed& run : o.rehearsal.runs) {
    tried += fmt::format("{}{} with {}", tried.empty() ? "" : ", ", fmt::format("{:.2f}", run.slowing),
                         run.particles);
    if (!run.broken_down.empty())
      lines.add("warning",
                fmt::format("rehearsed with {} particles it broke down after {:.0f} % of the time: {}",
                            run.particles, 100 * run.reached, run.broken_down));
  }
  if (!tried.empty())
    lines.add(
        "", fmt::format("{:.2f} times as many as the first one's length would make (rehearsed: {} particles)",
                        o.rehearsal.slowing, tried));
  lines.add("time",
            fmt::format("{} on {} thread{}, {} of them set-up; pictures come on top", duration(e.seconds),
                        threads(), threads() == 1 ? "" : "s", duration(o.setup_seconds)));
  lines.add("", fmt::format("{} of processor time for the steps, {:.3g} us a particle and step",
                            duration(e.cpu_seconds),
                            1e6 * e.step_cpu_seconds / static_cast<double>(o.quality.particles)));
}

} // namespace

Expectation expected(const Case& the_case, const Outlook& o) {
  const solver::Forecast& f = *o.forecast;
  const solver::SceneSpec& scene = the_case.scene;
  Expectation e;
  e.steps = static_cast<std::int64_t>(std::ceil(scene.end_time / f.dt * o.rehearsal.slowing));
  const auto steps = static_cast<double>(e.steps);
  e.step_cpu_seconds = f.step_cpu_seconds * o.rehearsal.costlier;
  e.cpu_seconds = steps * e.step_cpu_seconds;
  e.seconds = o.setup_seconds + steps * f.step_seconds * o.rehearsal.costlier +
              std::min<double>(scene.history_rows, steps) * f.row_seconds +
              std::min<double>(scene.frames, steps) * f.frame_seconds;
  return e;
}

std::string outlook_json(const Case& the_case, const Outlook& o, bool explained) {
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
  if (!o.forecast)
    return print(json);
  const solver::Forecast& f = *o.forecast;
  const Expectation e = expected(the_case, o);
  json["mass"] = f.mass;
  json["wave_speed"] = f.wave_speed;
  json["dt"] = f.dt;
  json["step"] = step_json(f.step);
  json["steps"] = e.steps;
  json["slowing"] = o.rehearsal.slowing;
  json["rehearsals"] = rehearsals_json(o.rehearsal);
  json["neighbours_mean"] = f.neighbours_mean;
  json["bytes_per_particle"] = f.bytes_per_particle;
  json["bytes_by_formulation"] = Json::object();
  for (const auto& [name, bytes] : f.bytes_by_formulation)
    json["bytes_by_formulation"][name] = bytes;
  json["seconds"] = e.seconds;
  json["cpu_seconds"] = e.cpu_seconds;
  json["setup_seconds"] = o.setup_seconds;
  json["us_per_particle_step"] = 1e6 * e.step_cpu_seconds / static_cast<double>(o.quality.particles);
  json["threads"] = threads();
  json["modelled"] = reasoned_json(f.modelled);
  json["left_out"] = reasoned_json(f.left_out);
  if (explained) {
    json["choices"] = reasoned_json(f.choices);
    json["step"]["frequency"] = f.step.frequency;
    json["step"]["decay"] = f.step.decay;
  }
  return print(json);
}

std::string outlook_text(const Case& the_case, const Outlook& o, bool explained) {
  const Vec3 size = o.upper - o.lower;
  Lines lines(the_case.title);
  lines.add("geometry", the_case.geometry_text());
  lines.add("bounding box", fmt::format("{:.6g} x {:.6g} x {:.6g} m, from ({:.6g}, {:.6g}, {:.6g}) m",
                                        size[0], size[1], size[2], o.lower[0], o.lower[1], o.lower[2]));
  if (o.quality.dimension == 2)
    lines.add("area", fmt::format("{:.6g} m^2 (CAD {:.6g} m^2), plane strain", o.quality.domain_volume,
                                  o.quality.cad_volume));
  else
    lines.add("volume",
              fmt::format("{:.6g} m^3 (CAD {:.6g} m^3)", o.quality.domain_volume, o.quality.cad_volume));
  lines.add("particles", fmt::format("{}, spacing {:.4g} m", o.quality.particles, o.spacing));
  lines.add("sets", o.sets.empty() ? "none" : fmt::format("{}", fmt::join(o.sets, ", ")));
  if (!o.forecast)
    return lines.text();
  const solver::Forecast& f = *o.forecast;
  lines.add("neighbours", fmt::format("{:.1f} each", f.neighbours_mean));
  lines.add("modelled", f.modelled);
  lines.add("left out", f.left_out);
  if (explained)
    lines.add("chosen", f.choices);
  lines.add("mass", fmt::format("{:.6g} kg", f.mass));
  lines.add("wave speed", fmt::format("{:.6g} m/s", f.wave_speed));
  lines.add("memory", fmt::format("{:.1f} MB ({:.0f} bytes a particle)",
                                  f.bytes_per_particle * static_cast<double>(o.quality.particles) / 1e6,
                                  f.bytes_per_particle));
  std::string others;
  for (const auto& [name, bytes] : f.bytes_by_formulation)
    others += fmt::format("{}{} {:.0f}", others.empty() ? "" : ", ", name, bytes);
  lines.add("", fmt::format("bytes a particle by formulation: {}", others));
  tell_time(the_case, o, lines);
  return lines.text();
}

} // namespace tessera::app

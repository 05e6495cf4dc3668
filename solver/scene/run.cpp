#include "core/history_columns.hpp"
#include "core/interrupt.hpp"
#include "solver/scene/assemble.hpp"
#include "solver/scene/observer.hpp"
#include "solver/scene/scene.hpp"
#include "solver/time/stable_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <type_traits>

namespace tessera::solver {
namespace {

double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Hands out frames and history rows as their times come; output never changes a step's length.
template <class Body>
class Reporter {
 public:
  Reporter(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs,
           const Assembly<Body>& assembly)
      : scene_(scene), cloud_(cloud), outputs_(outputs), assembly_(assembly) {
    for (const Probe& probe : scene.probes)
      probes_.emplace_back(probe, cloud);
    if (outputs.history_columns)
      outputs.history_columns(columns());
    const Momenta start = momenta(assembly.body);
    const Vec3 centre = mean_position();
    momenta_start_ = start;
    const auto& body = assembly.body;
    linear_scale_ = sum(body.size(), 0.0, [&](std::int64_t a) { return body.V[a] * body.U.p[a].norm(); });
    angular_scale_ = sum(body.size(), 0.0, [&](std::int64_t a) {
      return body.V[a] * body.U.p[a].norm() * (cloud.X[a] - centre).norm();
    });
    total_start_ = total(energies(body, assembly.step));
    report(0, 0, 0);
    frame(0, 0);
  }

  /// After a step: whatever is due.
  void after_step(double time, std::int64_t step, double dt) {
    if (time >= history_due_) {
      report(time, step, dt);
      history_due_ = next(time, scene_.history_rows);
    }
    if (time >= frame_due_) {
      frame(time, step);
      frame_due_ = next(time, scene_.frames);
    }
  }

  /// The state as it is now, whether due or not.
  void last(double time, std::int64_t step, double dt) {
    if (step != last_row_)
      report(time, step, dt);
    if (step != last_frame_)
      frame(time, step);
  }

  void summarise(Summary& summary) {
    summary.extremes = extremes_;
    summary.energy = energy_;
    summary.energy.balance_error = worst_balance_;
    arrays_.fill(assembly_.body, cloud_);
    arrays_.extent(cloud_, summary.extent_min, summary.extent_max);
    const Momenta now = momenta(assembly_.body);
    const auto relative = [](double change, double scale) { return scale > 0 ? change / scale : change; };
    summary.linear_drift = relative((now.linear - momenta_start_.linear).norm(), linear_scale_);
    summary.angular_drift = relative((now.angular - momenta_start_.angular).norm(), angular_scale_);
    for (std::size_t i = 0; i < probes_.size(); ++i)
      summary.probes.emplace_back(column_name(scene_.probes[i]),
                                  probes_[i].read(arrays_.probe_fields(cloud_)));
  }

 private:
  std::vector<std::string> columns() const {
    std::vector<std::string> names(history_columns.begin(), history_columns.end());
    for (const Probe& probe : scene_.probes)
      names.push_back(column_name(probe));
    return names;
  }

  Vec3 mean_position() const {
    return sum(cloud_.size(), Vec3(Vec3::Zero()), [&](std::int64_t a) -> Vec3 { return cloud_.X[a]; }) /
           static_cast<double>(cloud_.size());
  }

  double next(double time, int pieces) const {
    const double interval = scene_.end_time / pieces;
    // Half a millionth of an interval: a due time reached but for round-off counts as reached.
    return (std::floor(time / interval + 0.5e-6) + 1) * interval * (1 - 1e-12);
  }

  void report(double time, std::int64_t step, double dt) {
    last_row_ = step;
    energy_ = energies(assembly_.body, assembly_.step);
    largest_ = std::max(largest_, energy_.kinetic + energy_.internal + energy_.plastic);
    energy_.balance_error = largest_ > 0 ? std::abs(total(energy_) - total_start_) / largest_ : 0;
    worst_balance_ = std::max(worst_balance_, energy_.balance_error);
    arrays_.fill(assembly_.body, cloud_);
    arrays_.widen(extremes_);
    if (!outputs_.history_row)
      return;
    const Momenta m = momenta(assembly_.body);
    std::vector<double> row = {time,
                               static_cast<double>(step),
                               dt,
                               energy_.kinetic,
                               energy_.internal,
                               energy_.plastic,
                               energy_.dissipated,
                               energy_.external,
                               total(energy_),
                               energy_.balance_error};
    row.insert(row.end(), m.linear.begin(), m.linear.end());
    row.insert(row.end(), m.angular.begin(), m.angular.end());
    for (const ProbeReader& probe : probes_)
      row.push_back(probe.read(arrays_.probe_fields(cloud_)));
    outputs_.history_row(row);
  }

  void frame(double time, std::int64_t step) {
    last_frame_ = step;
    if (!outputs_.frame)
      return;
    arrays_.fill(assembly_.body, cloud_);
    outputs_.frame(arrays_.frame(time, step, cloud_));
  }

  const SceneSpec& scene_;
  const ParticleCloud& cloud_;
  const Outputs& outputs_;
  const Assembly<Body>& assembly_;
  std::vector<ProbeReader> probes_;
  FrameArrays arrays_;
  Momenta momenta_start_;
  double linear_scale_ = 0, angular_scale_ = 0;
  double total_start_ = 0, largest_ = 0;
  Energies energy_;
  double worst_balance_ = 0;
  Extremes extremes_;
  double history_due_ = next(0, scene_.history_rows), frame_due_ = next(0, scene_.frames);
  std::int64_t last_row_ = -1, last_frame_ = -1;
};

template <class Body>
Summary run_assembly(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs,
                     Progress& progress, Assembly<Body>& assembly) {
  auto& [body, step, distance] = assembly;
  double dt = stable_step(body, scene.cfl, distance);
  step.start(body, dt);
  Reporter<Body> reporter(scene, cloud, outputs, assembly);

  Summary summary;
  summary.formulation = Body::Formulation::name;
  summary.scheme = scene.scheme;
  summary.particles = cloud.size();
  summary.neighbours_mean = body.neighbours.mean();
  summary.support = *std::max_element(body.neighbours.support.begin(), body.neighbours.support.end());
  summary.threads = threads();
  summary.bytes_per_particle = bytes_per_particle(body);
  summary.dt_min = summary.dt_max = dt;

  double time = 0;
  const double start = seconds_now();
  progress.begin("solve", scene.end_time);
  while (time < scene.end_time) {
    dt = stable_step(body, scene.cfl, distance);
    summary.dt_min = std::min(summary.dt_min, dt);
    summary.dt_max = std::max(summary.dt_max, dt);
    const bool last = time + dt >= scene.end_time;
    if (last)
      dt = scene.end_time - time;
    try {
      step(body, dt);
    } catch (const Breakdown& breakdown) {
      reporter.last(time, summary.steps, dt);
      const Vec3 X = cloud.X[breakdown.particle];
      throw RunError(
          fmt::format("{} at particle {} (reference position {:.4g}, {:.4g}, {:.4g} m)",
                      breakdown.J > 0 ? std::string("a field is no longer finite")
                                      : fmt::format("the volume ratio J is {:.3g}", breakdown.J),
                      breakdown.particle, X[0], X[1], X[2]),
          fmt::format("step {}, time {:.6g} s", summary.steps + 1, time),
          "the last good frame is written: lower solver.cfl, raise solver.jst4 or refine the particles");
    }
    time = last ? scene.end_time : time + dt;
    ++summary.steps;
    reporter.after_step(time, summary.steps, dt);
    progress.advance(time, fmt::format("step {}, dt {:.3g} s", summary.steps, dt));
    if (interrupted()) {
      reporter.last(time, summary.steps, dt);
      throw RunError("interrupted", fmt::format("step {}, time {:.6g} s", summary.steps, time),
                     "frames and history up to here are written");
    }
  }
  reporter.last(time, summary.steps, dt);
  summary.wall_seconds = seconds_now() - start;
  summary.us_per_particle_step =
      1e6 * summary.wall_seconds /
      (static_cast<double>(summary.steps) * static_cast<double>(summary.particles));
  summary.time = time;
  reporter.summarise(summary);
  progress.finish(fmt::format("{} steps", summary.steps));
  return summary;
}

template <class Body>
Forecast forecast_assembly(const SceneSpec& scene, Assembly<Body>& assembly) {
  auto& [body, step, distance] = assembly;
  Forecast forecast;
  forecast.mass = body.density * sum(body.size(), 0.0, [&](std::int64_t a) { return body.V[a]; });
  forecast.wave_speed = body.wave_speed;
  forecast.dt = stable_step(body, scene.cfl, distance);
  forecast.steps = static_cast<std::int64_t>(std::ceil(scene.end_time / forecast.dt));
  forecast.neighbours_mean = body.neighbours.mean();
  forecast.bytes_per_particle = bytes_per_particle(body);

  constexpr bool jst = decltype(body.dissipation)::active;
  const auto place = [&](bool present, const std::string& what, const std::string& why_not) {
    if (present)
      forecast.modelled.push_back(what);
    else
      forecast.left_out.push_back(what + " (" + why_not + ")");
  };
  place(true, fmt::format("{{p, F}} in {} dimensions, {}", Body::dimension, scene.material.law), "");
  place(scene.material.plasticity.has_value(), "von Mises plasticity", "no [material.plasticity]");
  place(jst, "JST dissipation", "solver.jst4 = 0");
  place(scene.momentum_projection, "momentum projection", "solver.momentum_projection = false");
  place(!scene.fixed.empty(), "fixed velocities", "no [[boundary]]");
  place(!scene.walls.empty(), "contact with rigid planes", "no [[wall]]");

  // A few real steps on this machine; the first warms the caches.
  step.start(body, forecast.dt);
  step(body, forecast.dt);
  constexpr int tried = 4;
  const double start = seconds_now();
  for (int i = 0; i < tried; ++i)
    step(body, forecast.dt);
  forecast.seconds = (seconds_now() - start) / tried * static_cast<double>(forecast.steps);
  return forecast;
}

} // namespace

Summary run(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs, Progress& progress) {
  cloud.validate("");
  return with_assembly(
      scene, cloud, [&](auto& assembly) { return run_assembly(scene, cloud, outputs, progress, assembly); });
}

Forecast forecast(const SceneSpec& scene, const ParticleCloud& cloud) {
  cloud.validate("");
  return with_assembly(scene, cloud, [&](auto& assembly) { return forecast_assembly(scene, assembly); });
}

} // namespace tessera::solver

/// Frames, history rows and the summary of a run.
#pragma once

#include "core/history_columns.hpp"
#include "solver/scene/assemble.hpp"
#include "solver/scene/error_norms.hpp"
#include "solver/scene/observer.hpp"
#include "solver/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace tessera::solver {

/// Hands out frames and history rows as their times come; output never changes a step's length.
template <class Body>
class Reporter {
 public:
  Reporter(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs,
           Assembly<Body>& assembly)
      : scene_(scene), cloud_(cloud), outputs_(outputs), assembly_(assembly), arrays_(scene.fields) {
    for (const Probe& probe : scene.probes)
      probes_.emplace_back(probe, cloud);
    if (!assembly.step->walls().empty())
      for (const Vec3& A : cloud.A)
        boundary_area_.push_back(A.norm());
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
    total_start_ = total(energies(body, *assembly.step));
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
    summary.energy.balance_error = largest_ > 0 ? worst_imbalance_ / largest_ : 0;
    arrays_.fill(assembly_.body, cloud_);
    arrays_.extent(cloud_, summary.extent_min, summary.extent_max);
    const Momenta now = momenta(assembly_.body);
    const auto relative = [](double change, double scale) { return scale > 0 ? change / scale : change; };
    summary.linear_drift = relative((now.linear - momenta_start_.linear).norm(), linear_scale_);
    summary.angular_drift = relative((now.angular - momenta_start_.angular).norm(), angular_scale_);
    for (std::size_t i = 0; i < probes_.size(); ++i)
      summary.probes.emplace_back(column_name(scene_.probes[i]),
                                  probes_[i].read(arrays_.probe_fields(cloud_)));
    if (scene_.exact) {
      const ProbeFields fields = arrays_.probe_fields(cloud_);
      summary.error = error_norms(*scene_.exact, summary.time, cloud_,
                                  {fields.displacement, fields.velocity, fields.pressure});
    }
  }

 private:
  std::vector<std::string> columns() const {
    std::vector<std::string> names(history_columns.begin(), history_columns.end());
    for (const auto& wall : assembly_.step->walls())
      for (const std::string_view what : wall_columns)
        names.push_back(wall.name() + std::string(what));
    for (const std::string& support : assembly_.step->held().supports())
      for (const std::string_view what : reaction_columns)
        names.push_back(support + std::string(what));
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
    energy_ = energies(assembly_.body, *assembly_.step);
    largest_ = std::max(largest_, energy_.kinetic + energy_.internal + energy_.plastic);
    const double imbalance = std::abs(total(energy_) - total_start_);
    energy_.balance_error = largest_ > 0 ? imbalance / largest_ : 0;
    worst_imbalance_ = std::max(worst_imbalance_, imbalance);
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
    contact(time - last_row_time_, row);
    support(time - last_row_time_, row);
    last_row_time_ = time;
    for (ProbeReader& probe : probes_)
      row.push_back(probe.read(arrays_.probe_fields(cloud_)));
    outputs_.history_row(row);
  }

  static void append(const Vec<Body::dimension>& force, std::vector<double>& row) {
    Vec3 in_space = Vec3::Zero();
    in_space.template head<Body::dimension>() = force;
    row.insert(row.end(), in_space.begin(), in_space.end());
  }

  /// What the walls did in the time since the last row: mean forces, and the largest pressure on a particle's
  /// own surface.
  void contact(double elapsed, std::vector<double>& row) {
    for (auto& wall : assembly_.step->walls()) {
      const auto report = wall.report(assembly_.body.V, boundary_area_, elapsed);
      append(report.force, row);
      row.push_back(report.friction.norm());
      row.push_back(report.largest_pressure);
    }
  }

  /// The mean forces that held the body in that time.
  void support(double elapsed, std::vector<double>& row) {
    for (const auto& reaction : assembly_.step->held().report(assembly_.body.V, elapsed))
      append(reaction.force, row);
  }

  void frame(double time, std::int64_t step) {
    last_frame_ = step;
    if (!outputs_.frame)
      return;
    arrays_.fill(assembly_.body, cloud_);
    arrays_.derive(assembly_.body);
    outputs_.frame(arrays_.frame(time, step, cloud_));
  }

  const SceneSpec& scene_;
  const ParticleCloud& cloud_;
  const Outputs& outputs_;
  Assembly<Body>& assembly_;
  std::vector<ProbeReader> probes_;
  std::vector<double> boundary_area_; ///< m^2; empty where there is nothing to touch
  double last_row_time_ = 0;          ///< s
  FrameArrays arrays_;
  Momenta momenta_start_;
  double linear_scale_ = 0, angular_scale_ = 0;
  double total_start_ = 0, largest_ = 0;
  Energies energy_;
  double worst_imbalance_ = 0; ///< J
  Extremes extremes_;
  double history_due_ = next(0, scene_.history_rows), frame_due_ = next(0, scene_.frames);
  std::int64_t last_row_ = -1, last_frame_ = -1;
};

} // namespace tessera::solver

/// The largest step a body is taken with.
#pragma once

#include "core/parallel.hpp"
#include "solver/time/critical_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace tessera::solver {

/// The two steps a body's is taken from, s, both before sigma and share: the time the fastest wave takes over
/// the smallest particle distance, (3.93), and the critical step of its operator.
struct StepBounds {
  double by_wave, critical;
  bool critical_binds;
  double frequency, decay; ///< of the field the critical step belongs to: sqrt(K), rad/s, and C, 1/s
};

/// The smaller of two, each where it is asked for:
///   sigma times the smallest particle distance over c_max, (3.93), with c_max the fastest pressure wave as
///   the body is deformed;
///   a share of the critical step.
template <class Body>
class StepLimit {
 public:
  /// smallest: particle distance, m; sigma: infinite for no such limit; share: zero for none.
  StepLimit(double smallest, double sigma, double share)
      : smallest_(smallest), sigma_(sigma), share_(share) {}

  /// For the step to come, s.
  double operator()(Body& body) {
    const double by_distance = std::isfinite(sigma_) ? sigma_ * smallest_ / body.fastest_wave()
                                                     : std::numeric_limits<double>::infinity();
    return share_ == 0 ? by_distance : std::min(by_distance, share_ * follow(body, by_distance / share_));
  }

  /// Of the body as it is. The critical step is looked for where no step has asked for it.
  StepBounds bounds(Body& body) {
    if (stiffness_.empty())
      begin(body);
    const double critical = critical_.value();
    return {by_wave(body), critical, share_ > 0 && share_ * critical < sigma_ * by_wave(body),
            critical_.frequency(), critical_.decay()};
  }
  double critical() const { return critical_.value(); } ///< as last found, s; zero without

 private:
  double by_wave(const Body& body) const { return smallest_ / body.fastest_wave(); }

  /// The critical step, where it may be less than `enough`. Between one look at the operator and the next the
  /// particle that could vibrate fastest, the others held, says how it has shrunk.
  double follow(Body& body, double enough) {
    if (stiffness_.empty())
      begin(body);
    const double pace = fastest_pace(body);
    constexpr double hurry = 1.1, far = 2;
    if (critical_.value() * std::min(1.0, pace_ / pace) > far * enough)
      return enough;
    if (++since_ >= interval_ || pace > hurry * pace_) {
      constexpr int sweeps = 3;
      constexpr std::int64_t shortest = 8, longest = 64;
      const double expected = critical_.value() * pace_ / pace;
      critical_.refine(body, sweeps);
      const double surprise = std::abs(critical_.value() / expected - 1);
      interval_ = std::clamp(surprise < 0.01   ? 2 * interval_
                             : surprise > 0.03 ? interval_ / 2
                                               : interval_,
                             shortest, longest);
      pace_ = pace;
      since_ = 0;
    }
    return critical_.value() * std::min(1.0, pace_ / pace);
  }

  void begin(Body& body) {
    constexpr int from_scratch = 40;
    critical_.refine(body, from_scratch);
    stiffness_ = stiffness_of(body);
    pace_ = fastest_pace(body);
  }

  /// sqrt of the diagonal of the operator -div grad, 1/m.
  static std::vector<double> stiffness_of(const Body& body) {
    std::vector<double> stiffness(body.V.size());
    for_each(body.size(), [&](std::int64_t a) {
      Vec<Body::dimension> own = Vec<Body::dimension>::Zero();
      double diagonal = 0;
      for (std::int64_t e = body.neighbours.row[a]; e < body.neighbours.row[a + 1]; ++e) {
        const std::int32_t b = body.neighbours.column[e];
        own += body.gradient.w(a, e, b);
        diagonal += body.V[a] / body.V[b] * body.gradient.t(a, e, b).squaredNorm();
      }
      diagonal += own.squaredNorm();
      stiffness[a] = std::sqrt(diagonal);
    });
    return stiffness;
  }
  double fastest_pace(const Body& body) const {
    return max_of(body.size(), 0.0, [&](std::int64_t a) { return body.wave[a] * stiffness_[a]; });
  }

  double smallest_, sigma_, share_;
  CriticalStep<Body> critical_;
  std::vector<double> stiffness_; ///< of every particle, 1/m
  double pace_ = 0;               ///< when the operator was looked at last, 1/s
  std::int64_t since_ = 0, interval_ = 8;
};

} // namespace tessera::solver

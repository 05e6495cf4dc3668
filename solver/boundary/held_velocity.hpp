/// Velocities held in given directions: clamped, sliding, skew-symmetric and moving boundaries (table 2.4).
#pragma once

#include "core/parallel.hpp"
#include "core/tensor.hpp"
#include "solver/boundary/given_vector.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace tessera::solver {

/// One condition: n . v = n . w for every direction n of a particle of the set.
template <int D>
struct VelocityCondition {
  struct Held {
    std::int32_t particle;
    std::vector<Vec<D>> directions; ///< of unit length
  };
  std::vector<Held> held;
  std::optional<GivenVector> velocity; ///< w, m/s; zero unless given
};

/// All velocity conditions of a body, as one orthonormal frame of held directions for each particle: on an
/// edge between two sets both conditions hold, and where they contradict each other the later one wins.
template <int D>
class HeldVelocities {
 public:
  HeldVelocities() = default;

  /// X: reference positions, m; n = X.size().
  HeldVelocities(std::span<const VelocityCondition<D>> conditions, std::span<const Vec3> X) {
    std::vector<Frame> frames(X.size());
    for (std::size_t c = conditions.size(); c-- > 0;) {
      const bool moves = conditions[c].velocity.has_value();
      if (moves)
        velocities_.push_back(*conditions[c].velocity);
      for (const auto& held : conditions[c].held)
        for (const Vec<D>& n : held.directions)
          frames[static_cast<std::size_t>(held.particle)].add(
              n, moves ? static_cast<int>(velocities_.size()) - 1 : -1);
    }
    for (std::size_t a = 0; a < frames.size(); ++a) {
      Frame& frame = frames[a];
      if (frame.count == 0)
        continue;
      frame.particle = static_cast<std::int32_t>(a);
      frame.X = X[a];
      (frame.moves() ? moving_ : still_).push_back(frame);
    }
  }

  bool empty() const { return still_.empty() && moving_.empty(); }
  bool moving() const { return !moving_.empty(); }

  /// Gives the momenta (kg/(m^2 s)) their held components at `time` (s). What moving conditions change adds
  /// `share` times to `impulse`: held still, a particle takes no work.
  void apply(std::span<Vec<D>> p, double density, double time, double share,
             std::span<Vec<D>> impulse) const {
    for_each(static_cast<std::int64_t>(still_.size()), [&](std::int64_t i) {
      const Frame& frame = still_[i];
      Vec<D>& momentum = p[frame.particle];
      for (int k = 0; k < frame.count; ++k)
        momentum -= frame.axis[k] * frame.axis[k].dot(momentum);
    });
    std::vector<Vec3> uniform(velocities_.size());
    for (std::size_t i = 0; i < velocities_.size(); ++i)
      if (velocities_[i].uniform)
        uniform[i] = velocities_[i].value(Vec3::Zero(), time);
    for (const Frame& frame : moving_) { // formulas are not to be evaluated from several threads
      const Vec<D> before = p[frame.particle];
      Vec<D> momentum = before;
      for (int k = 0; k < frame.count; ++k) {
        double target = 0;
        for (const Part& part : frame.parts[k]) {
          const auto i = static_cast<std::size_t>(part.velocity);
          const Vec3 w = velocities_[i].uniform ? uniform[i] : velocities_[i].value(frame.X, time);
          target += part.weight.dot(w.template head<D>());
        }
        momentum += frame.axis[k] * (density * target - frame.axis[k].dot(momentum));
      }
      p[frame.particle] = momentum;
      impulse[frame.particle] += share * (momentum - before);
    }
  }

 private:
  /// weight . w of velocity number `velocity` is part of what an axis' component must be.
  struct Part {
    Vec<D> weight;
    int velocity;
  };

  struct Frame {
    std::int32_t particle = 0;
    int count = 0;
    Vec3 X = Vec3::Zero();
    std::array<Vec<D>, D> axis;
    std::array<std::vector<Part>, D> parts; ///< none: the axis is held still

    bool moves() const {
      for (const auto& of_axis : parts)
        if (!of_axis.empty())
          return true;
      return false;
    }

    /// One more direction, by Gram and Schmidt; one that the frame holds already changes nothing.
    void add(const Vec<D>& n, int velocity) {
      constexpr double parallel = 0.1; // sine of the angle below which two normals mean the same direction
      Vec<D> rest = n;
      std::vector<Part> part;
      if (velocity >= 0)
        part.push_back({n, velocity});
      for (int k = 0; k < count; ++k) {
        const double along = axis[k].dot(n);
        rest -= along * axis[k];
        for (const Part& other : parts[k])
          part.push_back({-along * other.weight, other.velocity});
      }
      const double length = rest.norm();
      if (count == D || length < parallel)
        return;
      for (Part& scaled : part)
        scaled.weight /= length;
      axis[count] = rest / length;
      parts[count] = std::move(part);
      ++count;
    }
  };

  std::vector<Frame> still_, moving_;
  std::vector<GivenVector> velocities_;
};

} // namespace tessera::solver

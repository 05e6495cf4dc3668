/// Velocities held in given directions: clamped, sliding, skew-symmetric and moving boundaries (table 2.4).
#pragma once

#include "core/parallel.hpp"
#include "core/tensor.hpp"
#include "solver/boundary/given_vector.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
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
  std::string support;                 ///< what holds them; conditions of one name share their reaction
};

/// What holds a part of the body, and the force with which it does so, on the body, mean over the time since
/// the last report: N; in the plane per metre of thickness.
template <int D>
struct Reaction {
  std::string support;
  Vec<D> force;
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
    for (const auto& condition : conditions)
      if (std::find(supports_.begin(), supports_.end(), condition.support) == supports_.end())
        supports_.push_back(condition.support);
    for (std::size_t c = conditions.size(); c-- > 0;) {
      const auto support = static_cast<int>(
          std::find(supports_.begin(), supports_.end(), conditions[c].support) - supports_.begin());
      const bool moves = conditions[c].velocity.has_value();
      if (moves)
        velocities_.push_back(*conditions[c].velocity);
      for (const auto& held : conditions[c].held)
        for (const Vec<D>& n : held.directions)
          frames[static_cast<std::size_t>(held.particle)].add(
              n, support, moves ? static_cast<int>(velocities_.size()) - 1 : -1);
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

  /// What holds the body, in the order of the conditions.
  const std::vector<std::string>& supports() const { return supports_; }

  /// Gives the momenta (kg/(m^2 s)) their held components at `time` (s). What moving conditions change adds
  /// `share` times to `impulse`: held still, a particle takes no work. All changes are noted for the report.
  void apply(std::span<Vec<D>> p, double density, double time, double share, std::span<Vec<D>> impulse) {
    for_each(static_cast<std::int64_t>(still_.size()), [&](std::int64_t i) {
      Frame& frame = still_[i];
      Vec<D>& momentum = p[frame.particle];
      for (int k = 0; k < frame.count; ++k) {
        const double along = frame.axis[k].dot(momentum);
        momentum -= frame.axis[k] * along;
        frame.impulse[k] -= share * along;
      }
    });
    std::vector<Vec3> uniform(velocities_.size());
    for (std::size_t i = 0; i < velocities_.size(); ++i)
      if (velocities_[i].uniform)
        uniform[i] = velocities_[i].value(Vec3::Zero(), time);
    for (Frame& frame : moving_) { // formulas are not to be evaluated from several threads
      const Vec<D> before = p[frame.particle];
      Vec<D> momentum = before;
      for (int k = 0; k < frame.count; ++k) {
        double target = 0;
        for (const Part& part : frame.parts[k]) {
          const auto i = static_cast<std::size_t>(part.velocity);
          const Vec3 w = velocities_[i].uniform ? uniform[i] : velocities_[i].value(frame.X, time);
          target += part.weight.dot(w.template head<D>());
        }
        const double change = density * target - frame.axis[k].dot(momentum);
        momentum += frame.axis[k] * change;
        frame.impulse[k] += share * change;
      }
      p[frame.particle] = momentum;
      impulse[frame.particle] += share * (momentum - before);
    }
  }

  /// The supports' reactions since the last report, over `elapsed` (s); V: subvolumes, m^3. A direction that
  /// two conditions hold counts to the later one.
  std::vector<Reaction<D>> report(std::span<const double> V, double elapsed) {
    std::vector<Reaction<D>> reactions;
    for (const std::string& support : supports_)
      reactions.push_back({support, Vec<D>::Zero()});
    for (auto* frames : {&still_, &moving_})
      for (Frame& frame : *frames) {
        for (int k = 0; k < frame.count && elapsed > 0; ++k)
          reactions[static_cast<std::size_t>(frame.support[k])].force +=
              V[frame.particle] * frame.impulse[k] / elapsed * frame.axis[k];
        frame.impulse.fill(0);
      }
    return reactions;
  }

  /// Memory of what is held, bytes.
  std::size_t bytes() const {
    std::size_t bytes = 0;
    for (const auto* frames : {&still_, &moving_}) {
      bytes += frames->capacity() * sizeof(Frame);
      for (const Frame& frame : *frames)
        for (const auto& parts : frame.parts)
          bytes += parts.capacity() * sizeof(Part);
    }
    return bytes;
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
    std::array<int, D> support{};           ///< number of what holds the axis
    std::array<double, D> impulse{};        ///< along the axis since the last report, kg/(m^2 s)
    std::array<std::vector<Part>, D> parts; ///< none: the axis is held still

    bool moves() const {
      for (const auto& of_axis : parts)
        if (!of_axis.empty())
          return true;
      return false;
    }

    /// One more direction, by Gram and Schmidt; one that the frame holds already changes nothing.
    void add(const Vec<D>& n, int holder, int velocity) {
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
      support[count] = holder;
      parts[count] = std::move(part);
      ++count;
    }
  };

  std::vector<Frame> still_, moving_;
  std::vector<GivenVector> velocities_;
  std::vector<std::string> supports_;
};

} // namespace tessera::solver

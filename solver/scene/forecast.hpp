/// What a scene would need and what it is made of, found without running it.
#pragma once

#include "core/particle_cloud.hpp"
#include "solver/scene/scene.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tessera::solver {

/// A part of the model, or a choice made for it, with the reason.
struct Reasoned {
  std::string what, why;
};

struct Forecast {
  double mass = 0;           ///< kg
  double wave_speed = 0;     ///< pressure wave, undeformed, m/s
  double fastest_motion = 0; ///< of what is thrown, pulled or pushed with given velocities, m/s
  double dt = 0;             ///< first step, s
  StepChoice step;
  std::int64_t steps = 0; ///< end_time / dt: more when the body is compressed
  double neighbours_mean = 0;
  double bytes_per_particle = 0;
  std::vector<std::pair<std::string, double>> bytes_by_formulation; ///< the same of every formulation
  double setup_seconds = 0;    ///< processor time of operators, conditions and first look at the step
  double step_cpu_seconds = 0; ///< processor time of a step, all threads together: median of batches taken
  double step_seconds = 0;     ///< the same by the clock
  double row_seconds = 0;      ///< of a history row, by the clock
  double frame_seconds = 0;    ///< of a frame with what `outputs` do with it
  std::vector<Reasoned> modelled, left_out; ///< parts of the model, and what this scene does without
  std::vector<Reasoned> choices; ///< formulation, scheme, dissipation ... with the numbers behind them
};

/// Assembles the scene and takes some steps of it on this machine, half a second's worth at most and no more
/// than the run would. `outputs.frame` is handed the body a few times, to see what a frame costs.
/// Throws as run() does before its first step.
Forecast forecast(const SceneSpec& scene, const ParticleCloud& cloud, const Outputs& outputs = {});

} // namespace tessera::solver

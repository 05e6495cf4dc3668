/// A case run in small ahead of time: by how much its steps shrink as the body deforms.
#pragma once

#include "app/case/case.hpp"
#include "core/progress.hpp"
#include "solver/scene/forecast.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace tessera::app {

/// One run of the scene on a coarser cloud of the same kind.
struct Rehearsed {
  std::int64_t particles = 0;
  double finesse = 0;      ///< particles^(1/dimension)
  double slowing = 1;      ///< steps over those that the first step's length would make
  double costlier = 1;     ///< mean time of a step over that of the first ones: flow and contact take some
  double reached = 1;      ///< share of the end time; the rest was taken to go on as it went last
  double cpu_seconds = 0;  ///< of its steps
  double heavier = 1;      ///< by how much the density was raised
  std::string broken_down; ///< what ended it before its time, if it did not stand
};

struct Rehearsal {
  std::vector<Rehearsed> runs; ///< the finest last
  double slowing = 1;          ///< expected of the case itself
  double costlier = 1;
};

/// Runs the case on 100, 300, 900 ... of its particles, or on all of them where they are few, as long as that
/// takes a few seconds. A body is squeezed further in a finer cloud: what a squeeze adds to the number of
/// steps grows as the particles along an edge do, and is carried on to the case's own by a straight line.
///
/// Slow motions, far below the speed of waves, are rehearsed with a denser body, whose waves are slower and
/// whose steps are fewer: forces of inertia stay small and nothing else knows of the density. Not where loads
/// drive the motion, which then would be another.
Rehearsal rehearse(const Case& the_case, const solver::SceneSpec& scene, const preprocess::Domain& domain,
                   const ParticleCloud& cloud, const solver::Forecast& forecast, Progress& progress);

/// The line of least squares through the runs and a slowing of 1 at two particles an edge, at `finesse`: at
/// least 1. That end keeps the line from following the scatter of a few coarse clouds.
double expected_slowing(const std::vector<Rehearsed>& runs, double finesse);

} // namespace tessera::app

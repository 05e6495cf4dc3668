/// What the study of hyperbolicity found, for people, programs and docs.
#pragma once

#include "postprocess/render_job.hpp"
#include "solver/physics/materials/hyperbolicity.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tessera::app {

/// Aligned for a terminal: a line a law.
std::string hyperbolicity_table(const std::vector<solver::Hyperbolicity>& laws);

/// The paths point by point: law, constants, path, stretch, the three stretches, slowest rho0 c^2 over mu.
std::string hyperbolicity_csv(const std::vector<solver::Hyperbolicity>& laws);

/// Everything but the points of the paths.
std::string hyperbolicity_json(const std::vector<solver::Hyperbolicity>& laws);

/// The regions of hyperbolicity in two planes of stretches, and the slowest wave along uniaxial stress.
post::Plot hyperbolicity_plot(const std::vector<solver::Hyperbolicity>& laws,
                              const std::filesystem::path& file);

} // namespace tessera::app

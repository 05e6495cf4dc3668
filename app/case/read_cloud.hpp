/// The part of a case the particles depend on: [geometry], [particles] and [[set]].
#pragma once

#include "app/case/table.hpp"
#include "preprocess/cloud/prepare.hpp"
#include "preprocess/geometry/import.hpp"

#include <filesystem>
#include <vector>

namespace tessera::app {

preprocess::GeometrySource read_geometry(Table geometry, const std::filesystem::path& case_folder);

/// For a body of `dimension` 2 or 3.
preprocess::ParticleRequest read_particles(Table particles, int dimension);

preprocess::SetSelector read_set(Table set, const std::vector<preprocess::SetSelector>& earlier);

} // namespace tessera::app

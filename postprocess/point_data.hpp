/// A frame's numbers as a table for other programs.
#pragma once

#include "postprocess/snapshot.hpp"

#include <string>

namespace tessera::post {

/// One line a particle after a line of names: reference and current position, subvolume, then every stored
/// array, components apart ("Stress_xy_Pa"); units as the names' suffixes, numbers as precise as the frame.
std::string point_data_csv(const Snapshot& snapshot);

} // namespace tessera::post

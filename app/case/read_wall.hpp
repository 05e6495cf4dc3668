/// [[wall]]: the rigid tools a body may meet.
#pragma once

#include "app/case/table.hpp"
#include "preprocess/geometry/import.hpp"
#include "solver/scene/scene.hpp"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace tessera::app {

/// A wall whose shape is a file's surface, imported when it is needed.
struct WallSurface {
  std::size_t entry; ///< index of its [[wall]]
  std::size_t wall;  ///< index into SceneSpec::walls, whose shape is null
  preprocess::GeometrySource source;
};

struct Walls {
  std::vector<solver::WallSpec> walls;
  std::vector<WallSurface> surfaces;
};

/// The walls of a body of `dimension` 2 or 3: one an entry, two of a channel. Without a name they are wall_1,
/// wall_2, ... by their entries; the sides of a channel end in _left and _right.
Walls read_walls(const std::vector<Table>& entries, int dimension, const std::filesystem::path& case_folder);

} // namespace tessera::app

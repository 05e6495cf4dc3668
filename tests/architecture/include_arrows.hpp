/// Which file may include which: the arrows between the folders of the source tree.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tessera::architecture {

/// What breaks the rules below `root`, one line each ("solver/a.cpp:3: ..."), in order of file and line:
///   core <- {preprocess, solver, io} <- postprocess <- app,
///   inside solver: operators <- physics <- boundary <- time <- scene,
///   VTK and HDF5 only in io and postprocess, CGAL, gmsh and Voro++ only in preprocess, TOML and CLI11 only
///   in app, own headers by their path from the root.
std::vector<std::string> violations(const std::filesystem::path& root);

/// Source files looked at by violations(): a rule that saw no file proves nothing.
std::vector<std::filesystem::path> source_files(const std::filesystem::path& root);

} // namespace tessera::architecture

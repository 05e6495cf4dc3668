/// A case file: one scene, from its CAD file to its pictures, read strictly and in full before any work is
/// done.
#pragma once

#include "app/case/read_wall.hpp"
#include "postprocess/picture.hpp"
#include "preprocess/cloud/prepare.hpp"
#include "preprocess/geometry/import.hpp"
#include "solver/scene/scene.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tessera::app {

/// Lengths in the case ([particles], [[set]], [[wall]], geometry.mesh_size) are metres whatever the CAD
/// file's unit.
struct Case {
  std::string title;
  std::string
      name; ///< short: "taylor_bar" for .../taylor_bar/case.toml, "taylor_bar-voronoi" for voronoi.toml
  std::filesystem::path path; ///< of the case file
  preprocess::GeometrySource geometry;
  preprocess::ParticleRequest particles;
  bool has_scene = false; ///< false: only particles are described
  solver::SceneSpec scene;
  std::vector<WallSurface> wall_surfaces; ///< of the scene's walls, still to be imported
  std::vector<post::Picture> pictures;

  /// The case as TOML with the overrides applied and the CAD file's path made absolute: what DIR/case.toml
  /// holds.
  std::string text;
  /// The part of `text` the particles depend on: two cases that agree in it share their cloud.
  std::string cloud_text;
  /// Where a key such as "material.poisson" or "wall.0.restitution" was written: file:line:column or "--set
  /// ...".
  std::function<std::string(const std::string& key)> where;

  /// The geometry in a few words: the file and its unit, or the shape and its lengths.
  std::string geometry_text() const;
  /// InputError where there is nothing to solve.
  void require_scene() const;
};

/// Reads `file` (or file/case.toml where it is a folder) and applies `overrides`, each "dotted.key=value".
/// InputError, naming file, line and column, on anything unknown, missing, of the wrong type or out of range.
Case read_case(const std::filesystem::path& file, const std::vector<std::string>& overrides);

} // namespace tessera::app

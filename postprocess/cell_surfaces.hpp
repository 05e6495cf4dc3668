/// Voronoi cells as they are looked at: pieces of one cell joined, their outer faces and true edges.
#pragma once

#include "core/cell_mesh.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace tessera::post {

struct CellSurfaces {
  struct Face {
    std::int32_t particle;          ///< whose cell it bounds
    std::vector<std::int32_t> loop; ///< indices into `points`, counter-clockwise seen from outside
  };
  std::vector<Vec3> points; ///< m
  std::vector<Face> faces;
  std::vector<std::array<std::int32_t, 2>> edges; ///< where faces of one cell meet at more than 15 degrees
};

/// The cells of the particles with shown[particle]. Where the tetrahedra of the body cut a cell into pieces,
/// the cuts inside it are left out, and so are the traces they leave on its faces. Points of one cell nearer
/// than `tolerance` (m) are one. Plane cells are polygons: their rims are edges.
CellSurfaces cell_surfaces(const CellMesh& mesh, const std::vector<bool>& shown, double tolerance);

} // namespace tessera::post

/// gmsh's current plane model in the words of PlaneFigure and Domain.
#pragma once

#include "preprocess/geometry/importer/request.hpp"
#include "preprocess/geometry/slab.hpp"

#include <string>
#include <unordered_map>
#include <vector>

namespace tessera::importer {

/// A figure with gmsh's tags beside it.
struct TaggedFigure {
  preprocess::PlaneFigure figure;
  std::unordered_map<std::size_t, std::int32_t> vertex_of_node;
  std::vector<int> curve_tags; ///< gmsh tag of each of figure.curves
  double z = 0;                ///< of its plane
};

constexpr double flat = 1e-6; ///< of the diagonal: what a CAD program calls plane
constexpr const char* plane_remedy = "plane bodies are drawn in a plane z = const";
std::string not_plane(int surface, std::size_t count, double low, double high);

/// Triangles of these surfaces, all of the model's when empty. Throws InputError when they do not lie in one
/// plane z = const.
TaggedFigure read_triangles(const std::vector<int>& surfaces, const Request& request);

/// Finds the sides and gives them the curve whose line elements they are; curves are named edge1, edge2... by
/// tag. False when some side has none.
bool read_sides(TaggedFigure& tagged, const Request& request);

/// Physical groups of curves, points and surfaces as groups of the slab.
void read_plane_groups(const TaggedFigure& tagged, const std::vector<int>& surfaces,
                       preprocess::Domain& domain);

} // namespace tessera::importer

/// Bare triangle surfaces: are they closed, what do they enclose, how many shells are there.
#pragma once

#include "core/tensor.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tessera::preprocess {

using Triangle = std::array<std::int32_t, 3>;
using Edge = std::array<std::int32_t, 2>;

struct Triangles {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

/// Edges that do not have exactly two triangles, lower vertex first, sorted.
std::vector<Edge> unpaired_edges(std::span<const Triangle> triangles);

/// Shell (edge-connected piece) of each triangle, numbered by first appearance. Only edges of exactly two
/// triangles connect.
std::vector<std::int32_t> shells_of(std::span<const Triangle> triangles);

/// Turns triangles so that both triangles of each edge agree; the first of each shell decides. False when a
/// shell cannot be oriented (a Moebius band, a Klein bottle).
bool orient(std::span<Triangle> triangles);

/// Volume of each shell of a closed, oriented surface, positive when its triangles face outwards.
std::vector<double> shell_volumes(const std::vector<Vec3>& vertices, std::span<const Triangle> triangles,
                                  std::span<const std::int32_t> shells);

} // namespace tessera::preprocess

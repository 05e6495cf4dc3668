#include "preprocess/geometry/triangles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tessera::preprocess {
namespace {

/// One side of a triangle; `forward` when it runs from the lower vertex to the higher.
struct Side {
  Edge edge;
  std::int32_t triangle;
  bool forward;
};

std::vector<Side> sorted_sides(std::span<const Triangle> triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int e = 0; e < 3; ++e) {
      const std::int32_t a = triangles[t][e], b = triangles[t][(e + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, static_cast<std::int32_t>(t), a < b});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
  });
  return sides;
}

/// Calls f(first, last) for each edge's run of sides.
template <class F>
void for_each_edge(const std::vector<Side>& sides, F&& f) {
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i + 1;
    while (j < sides.size() && sides[j].edge == sides[i].edge)
      ++j;
    f(i, j);
    i = j;
  }
}

/// Neighbour of each triangle across each paired edge, and whether the two run along it the same way
/// (disagree).
struct Neighbour {
  std::int32_t triangle;
  bool disagrees;
};

std::vector<std::vector<Neighbour>> neighbours(std::span<const Triangle> triangles) {
  std::vector<std::vector<Neighbour>> across(triangles.size());
  const auto sides = sorted_sides(triangles);
  for_each_edge(sides, [&](std::size_t i, std::size_t j) {
    if (j - i != 2)
      return;
    const bool disagrees = sides[i].forward == sides[i + 1].forward;
    across[sides[i].triangle].push_back({sides[i + 1].triangle, disagrees});
    across[sides[i + 1].triangle].push_back({sides[i].triangle, disagrees});
  });
  return across;
}

} // namespace

std::vector<Edge> unpaired_edges(std::span<const Triangle> triangles) {
  std::vector<Edge> unpaired;
  const auto sides = sorted_sides(triangles);
  for_each_edge(sides, [&](std::size_t i, std::size_t j) {
    if (j - i != 2)
      unpaired.push_back(sides[i].edge);
  });
  return unpaired;
}

std::vector<std::int32_t> shells_of(std::span<const Triangle> triangles) {
  const auto across = neighbours(triangles);
  std::vector<std::int32_t> shell(triangles.size(), -1), waiting;
  std::int32_t count = 0;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed) {
    if (shell[seed] >= 0)
      continue;
    shell[seed] = count;
    waiting.push_back(static_cast<std::int32_t>(seed));
    while (!waiting.empty()) {
      const std::int32_t t = waiting.back();
      waiting.pop_back();
      for (const auto& next : across[t])
        if (shell[next.triangle] < 0) {
          shell[next.triangle] = count;
          waiting.push_back(next.triangle);
        }
    }
    ++count;
  }
  return shell;
}

bool orient(std::span<Triangle> triangles) {
  const auto across = neighbours(triangles);
  std::vector<signed char> turn(triangles.size(), 0); // 1 as it is, -1 to be turned
  std::vector<std::int32_t> waiting;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed) {
    if (turn[seed] != 0)
      continue;
    turn[seed] = 1;
    waiting.push_back(static_cast<std::int32_t>(seed));
    while (!waiting.empty()) {
      const std::int32_t t = waiting.back();
      waiting.pop_back();
      for (const auto& next : across[t]) {
        const auto wanted = static_cast<signed char>(next.disagrees ? -turn[t] : turn[t]);
        if (turn[next.triangle] == 0) {
          turn[next.triangle] = wanted;
          waiting.push_back(next.triangle);
        } else if (turn[next.triangle] != wanted) {
          return false;
        }
      }
    }
  }
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (turn[t] < 0)
      std::swap(triangles[t][1], triangles[t][2]);
  return true;
}

std::vector<double> shell_volumes(const std::vector<Vec3>& vertices, std::span<const Triangle> triangles,
                                  std::span<const std::int32_t> shells) {
  std::vector<double> volumes;
  const Vec3 origin =
      vertices.empty() ? Vec3(Vec3::Zero()) : vertices[triangles.empty() ? 0 : triangles[0][0]];
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto s = static_cast<std::size_t>(shells[t]);
    if (s >= volumes.size())
      volumes.resize(s + 1, 0);
    const Vec3 A = vertices[triangles[t][0]] - origin;
    volumes[s] += A.dot((vertices[triangles[t][1]] - origin).cross(vertices[triangles[t][2]] - origin)) / 6;
  }
  return volumes;
}

} // namespace tessera::preprocess

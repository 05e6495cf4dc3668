#include "postprocess/refine.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <unordered_map>

namespace tessera::post {
namespace {

class Refiner {
 public:
  Refiner(std::vector<Vec3>& points, double longest) : points_(points), longest2_(longest * longest) {}

  template <std::size_t N>
  std::vector<std::array<std::int32_t, N>> operator()(std::vector<std::array<std::int32_t, N>> waiting) {
    std::vector<std::array<std::int32_t, N>> done;
    std::reverse(waiting.begin(), waiting.end());
    while (!waiting.empty()) {
      const auto simplex = waiting.back();
      waiting.pop_back();
      std::tuple<double, std::int32_t, std::int32_t> longest{longest2_, -1, -1};
      std::size_t from = 0, to = 0;
      for (std::size_t i = 0; i < N; ++i)
        for (std::size_t j = i + 1; j < N; ++j) {
          const auto [a, b] = std::minmax(simplex[i], simplex[j]);
          const std::tuple edge{(points_[b] - points_[a]).squaredNorm(), a, b};
          if (edge > longest) {
            longest = edge;
            from = i;
            to = j;
          }
        }
      // Equally long edges go by their numbers: which is halved first is the same in all their simplices.
      if (!(std::get<0>(longest) > longest2_)) {
        done.push_back(simplex);
        continue;
      }
      const std::int32_t middle = midpoint(std::get<1>(longest), std::get<2>(longest));
      auto half = simplex;
      half[from] = middle;
      waiting.push_back(half);
      half = simplex;
      half[to] = middle;
      waiting.push_back(half);
    }
    return done;
  }

 private:
  std::int32_t midpoint(std::int32_t a, std::int32_t b) {
    const auto key = static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
    const auto [found, fresh] = midpoints_.try_emplace(key, static_cast<std::int32_t>(points_.size()));
    if (fresh)
      points_.push_back(0.5 * (points_[a] + points_[b]));
    return found->second;
  }

  std::vector<Vec3>& points_;
  double longest2_;
  std::unordered_map<std::uint64_t, std::int32_t> midpoints_;
};

} // namespace

BodyMesh refined(const BodyMesh& mesh, double longest) {
  BodyMesh fine{mesh.dimension, mesh.points, {}, {}, {}};
  Refiner refine(fine.points, longest);
  fine.solids = refine(mesh.solids);
  fine.faces = refine(mesh.faces);
  fine.edges = refine(mesh.edges);
  return fine;
}

} // namespace tessera::post

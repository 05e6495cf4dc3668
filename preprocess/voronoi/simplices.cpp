#include "preprocess/voronoi/simplices.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace tessera::preprocess {
namespace {

/// The simplices at each point, in compressed rows.
struct Incidence {
  std::vector<std::int64_t> rows;
  std::vector<std::int32_t> simplices;

  Incidence(std::int64_t points, const std::vector<Simplex>& all) : rows(points + 1, 0) {
    // Each thread sees all simplices and keeps to its own range of points: no two write to one row.
    const std::int64_t parts = std::max(1, threads());
    const auto each = [&](auto&& visit) {
      for_each_task(parts, [&](std::int64_t p) {
        const std::int64_t begin = points * p / parts, end = points * (p + 1) / parts;
        for (std::size_t s = 0; s < all.size(); ++s)
          for (const std::int32_t v : all[s])
            if (v >= begin && v < end)
              visit(v, static_cast<std::int32_t>(s));
      });
    };
    each([&](std::int32_t v, std::int32_t) { ++rows[v + 1]; });
    for (std::int64_t i = 0; i < points; ++i)
      rows[i + 1] += rows[i];
    simplices.resize(rows.back());
    std::vector<std::int64_t> fill(rows.begin(), rows.end() - 1);
    each([&](std::int32_t v, std::int32_t s) { simplices[fill[v]++] = s; });
  }
};

/// Marks of one thread: who has been met in this round.
class Marks {
 public:
  void begin(std::size_t points) {
    if (met_.size() < points)
      met_.resize(points, 0);
    if (++round_ == 0) {
      std::fill(met_.begin(), met_.end(), 0);
      round_ = 1;
    }
  }
  bool first_time(std::int32_t i) { return std::exchange(met_[i], round_) != round_; }

 private:
  std::vector<std::uint32_t> met_;
  std::uint32_t round_ = 0;
};

} // namespace

DelaunayGraph graph_of(const std::vector<Vec3>& points, const std::vector<Simplex>& simplices) {
  const auto n = static_cast<std::int64_t>(points.size());
  const Incidence incidence(n, simplices);
  DelaunayGraph graph;
  graph.rows.assign(n + 1, 0);
  constexpr std::int64_t block = 512;
  const std::int64_t blocks = (n + block - 1) / block;
  std::vector<std::vector<std::int32_t>> columns(blocks);
  for_each_task(blocks, [&](std::int64_t b) {
    thread_local Marks marks;
    std::vector<std::pair<double, std::int32_t>> row; // by distance
    for (std::int64_t i = b * block; i < std::min(n, (b + 1) * block); ++i) {
      marks.begin(points.size());
      marks.first_time(static_cast<std::int32_t>(i));
      row.clear();
      for (std::int64_t k = incidence.rows[i]; k < incidence.rows[i + 1]; ++k)
        for (const std::int32_t j : simplices[incidence.simplices[k]])
          if (j >= 0 && marks.first_time(j))
            row.emplace_back((points[j] - points[i]).squaredNorm(), j);
      std::sort(row.begin(), row.end());
      for (const auto& [distance, j] : row)
        columns[b].push_back(j);
      graph.rows[i + 1] = static_cast<std::int64_t>(row.size());
    }
  });
  for (std::int64_t i = 0; i < n; ++i)
    graph.rows[i + 1] += graph.rows[i];
  graph.columns.resize(graph.rows[n]);
  for_each(blocks, [&](std::int64_t b) {
    std::copy(columns[b].begin(), columns[b].end(), graph.columns.begin() + graph.rows[b * block]);
  });
  return graph;
}

void refuse_coinciding(const std::vector<Vec3>& points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  const auto less = [&](std::size_t a, std::size_t b) {
    const Vec3 &p = points[a], &q = points[b];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  std::sort(order.begin(), order.end(), less);
  for (std::size_t k = 1; k < order.size(); ++k)
    if (points[order[k - 1]] == points[order[k]])
      throw InputError(fmt::format("points {} and {} coincide", std::min(order[k - 1], order[k]),
                                   std::max(order[k - 1], order[k])),
                       "Voronoi tessellation", "remove one of them");
}

} // namespace tessera::preprocess

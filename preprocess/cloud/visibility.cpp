#include "preprocess/cloud/visibility.hpp"

#include "core/neighbours.hpp"
#include "core/parallel.hpp"
#include "core/point_grid.hpp"
#include "preprocess/voronoi/tet_body.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tessera::preprocess {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Point point(const Vec3& x) {
  return {x[0], x[1], x[2]};
}

/// The boundary without the lids of a slab, in coordinates in which the spacing is about 1.
class Boundary {
 public:
  Boundary(const Domain& domain, const Scaling& scaling) {
    for (const Domain::Facet& facet : domain.facets) {
      if (facet.surface == Domain::lid)
        continue;
      std::array<Vec3, 3> x;
      for (int k = 0; k < 3; ++k)
        x[k] = scaling.in(domain.vertices[facet.vertices[k]]);
      corners_.push_back(x);
      normals_.push_back((x[1] - x[0]).cross(x[2] - x[0]).normalized());
      triangles_.emplace_back(point(x[0]), point(x[1]), point(x[2]));
    }
    tree_.insert(triangles_.begin(), triangles_.end());
    tree_.build();
    size_ = scaling.in(domain.upper) - scaling.in(domain.lower);
    dimension_ = domain.dimension;
  }

  /// Whether the way between two points inside leaves the body: it crosses the boundary out and in again. A
  /// way that only touches it (on a symmetric lattice many meet a re-entrant edge) does not.
  bool leaves_between(const Vec3& a, const Vec3& b) const {
    std::vector<Tree::Primitive_id> met;
    tree_.all_intersected_primitives(Segment(point(a), point(b)), std::back_inserter(met));
    double first = 1, last = 0;
    for (const auto facet : met) {
      const auto at = static_cast<std::size_t>(facet - triangles_.begin());
      const double speed = normals_[at].dot(b - a);
      if (speed == 0)
        continue; // along the facet: those beside it tell
      const double t = normals_[at].dot(corners_[at][0] - a) / speed;
      first = std::min(first, t);
      last = std::max(last, t);
    }
    return (last - first) * (b - a).norm() > a_touch;
  }

  bool inside(const Vec3& x) const {
    // Odd crossings on the way out, in a direction no part is aligned with.
    Vec3 way(0.8090169943749475, 0.5415412812, dimension_ == 2 ? 0 : 0.2287359921);
    way *= 2 * size_.norm();
    return tree_.number_of_intersected_primitives(Segment(point(x), point(x + way))) % 2 == 1;
  }

  /// Whether the body could fail to be convex within `radius` of x: some facet there lies before another's
  /// plane.
  bool hollow_near(const Vec3& x, double radius) const {
    const Vec3 reach = Vec3::Constant(radius);
    std::vector<Tree::Primitive_id> near;
    tree_.all_intersected_primitives(CGAL::Bbox_3(x[0] - reach[0], x[1] - reach[1], x[2] - reach[2],
                                                  x[0] + reach[0], x[1] + reach[1], x[2] + reach[2]),
                                     std::back_inserter(near));
    if (near.size() > largest_convex_check)
      return true;
    for (const auto f : near)
      for (const auto g : near)
        for (const Vec3& corner : corners_[g - triangles_.begin()]) {
          const auto at = static_cast<std::size_t>(f - triangles_.begin());
          if (normals_[at].dot(corner - corners_[at][0]) > flat)
            return true;
        }
    return false;
  }

 private:
  static constexpr std::size_t largest_convex_check = 400; ///< facets, above it every pair is tested
  static constexpr double flat = 1e-9;                     ///< spacings
  static constexpr double a_touch = 1e-6;                  ///< spacings; narrower slots are none
  std::vector<std::array<Vec3, 3>> corners_;
  std::vector<Vec3> normals_;
  std::vector<Triangle> triangles_;
  Tree tree_;
  Vec3 size_;
  int dimension_ = 3;
};

/// A particle's eye: its cell's centroid, or nearer to the particle where that lies outside the body.
struct Eye {
  Vec3 x;
  bool open = false;
};

Eye eye_of(const Boundary& boundary, const Vec3& X, const Vec3& centroid) {
  for (const double part : {1.0, 0.5, 0.25, 0.125}) {
    const Vec3 x = X + part * (centroid - X);
    if (boundary.inside(x))
      return {x, true};
  }
  return {X, false};
}

} // namespace

HiddenPairs hidden_pairs(const Domain& domain, const ParticleCloud& cloud, const std::vector<double>& sight) {
  const std::int64_t n = cloud.size();
  const Scaling scaling = scaling_for(domain, cloud.spacing);
  const double L = scaling.length;
  const Boundary boundary(domain, scaling);

  std::vector<std::uint8_t> doubtful(n);
  for_each_uneven(n, [&](std::int64_t a) {
    const double margin = (cloud.centroid[a] - cloud.X[a]).norm() + cloud.spacing;
    doubtful[a] = boundary.hollow_near(scaling.in(cloud.X[a]), (sight[a] + margin) / L);
  });
  const PointGrid grid(cloud.X, *std::max_element(sight.begin(), sight.end()));
  // Eyes of all who may be one of a doubtful pair.
  std::vector<std::uint8_t> looked_at(doubtful);
  for (std::int64_t a = 0; a < n; ++a)
    if (doubtful[a])
      grid.near(cloud.X[a], sight[a], [&](std::int32_t b, double r) { looked_at[b] |= r < sight[a]; });
  std::vector<Eye> eyes(n);
  for_each_uneven(n, [&](std::int64_t a) {
    if (looked_at[a])
      eyes[a] = eye_of(boundary, scaling.in(cloud.X[a]), scaling.in(cloud.centroid[a]));
  });

  std::vector<std::vector<std::array<std::int32_t, 2>>> hidden(n);
  for_each_uneven(n, [&](std::int64_t a) {
    if (!doubtful[a] || !eyes[a].open)
      return;
    grid.near(cloud.X[a], sight[a], [&](std::int32_t b, double r) {
      if (b == a || r >= sight[a] || !eyes[b].open)
        return;
      // A partner who sees as far decides too: all convex around it means nothing lies between, and of two
      // doubtful ones the first one looks.
      if (r < sight[b] && (!doubtful[b] || b < a))
        return;
      if (boundary.leaves_between(eyes[a].x, eyes[b].x))
        hidden[a].push_back(
            {std::min(static_cast<std::int32_t>(a), b), std::max(static_cast<std::int32_t>(a), b)});
    });
  });
  std::vector<std::array<std::int32_t, 2>> pairs;
  for (const auto& part : hidden)
    pairs.insert(pairs.end(), part.begin(), part.end());
  std::sort(pairs.begin(), pairs.end());
  return {n, std::move(pairs)};
}

void look_around(const Domain& domain, int neighbours, double reach, ParticleCloud& cloud) {
  constexpr double margin = 1.5; ///< over the k-th visible one: supports grow where those lie in a plane
  if (cloud.arrangement == "lattice") {
    cloud.sight.assign(cloud.X.size(), reach * cloud.spacing);
    cloud.hidden = hidden_pairs(domain, cloud, cloud.sight);
    return;
  }
  const int others = static_cast<int>(std::min<std::int64_t>(neighbours, cloud.size() - 1));
  cloud.hidden = {};
  cloud.sight.assign(cloud.X.size(), 0);
  // Whoever loses neighbours to a slot looks farther along its own side, which may reveal more of them.
  for (int round = 0; round < 4; ++round) {
    const std::vector<double> visible = distance_to_nearest(cloud.X, others, cloud.hidden);
    bool farther = false;
    for (std::size_t a = 0; a < visible.size(); ++a)
      if (const double wanted = margin * visible[a]; wanted > cloud.sight[a]) {
        cloud.sight[a] = wanted;
        farther = true;
      }
    if (!farther)
      break;
    cloud.hidden = hidden_pairs(domain, cloud, cloud.sight);
    if (cloud.hidden.pairs().empty())
      break;
  }
}

} // namespace tessera::preprocess

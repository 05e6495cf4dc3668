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
#include <numeric>
#include <optional>
#include <span>

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

/// Finds the hidden pairs of a few particles at a time.
class Lookout {
 public:
  Lookout(const Domain& domain, const ParticleCloud& cloud)
      : cloud_(cloud), scaling_(scaling_for(domain, cloud.spacing)), boundary_(domain, scaling_),
        grid_(cloud.X, 2 * cloud.spacing), doubtful_(cloud.X.size()), eyes_(cloud.X.size()),
        hidden_(cloud.X.size()) {}

  /// Looks around from those listed, each as far as its own sight.
  void look(std::span<const std::int32_t> from, const std::vector<double>& sight) {
    const auto n = static_cast<std::int64_t>(from.size());
    for_each_uneven(n, [&](std::int64_t i) {
      const std::int32_t a = from[i];
      const double margin = (cloud_.centroid[a] - cloud_.X[a]).norm() + cloud_.spacing;
      doubtful_[a] = boundary_.hollow_near(scaling_.in(cloud_.X[a]), (sight[a] + margin) / scaling_.length);
    });
    open_eyes(from, sight);
    std::vector<std::uint8_t> looking(cloud_.X.size());
    for (const std::int32_t a : from)
      looking[a] = 1;
    for_each_uneven(n, [&](std::int64_t i) {
      const std::int32_t a = from[i];
      hidden_[a].clear();
      if (!doubtful_[a] || !eyes_[a]->open)
        return;
      grid_.near(cloud_.X[a], sight[a], [&](std::int32_t b, double r) {
        if (b == a || r >= sight[a] || !eyes_[b]->open)
          return;
        // A partner who sees as far decides too: all convex around it means nothing lies between. Of two who
        // look at each other one does the work.
        if (r < sight[b] && (!doubtful_[b] || (looking[b] && b < a)))
          return;
        if (boundary_.leaves_between(eyes_[a]->x, eyes_[b]->x))
          hidden_[a].push_back({std::min(a, b), std::max(a, b)});
      });
    });
  }

  HiddenPairs hidden() const {
    std::vector<std::array<std::int32_t, 2>> pairs;
    for (const auto& of_one : hidden_)
      pairs.insert(pairs.end(), of_one.begin(), of_one.end());
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return {cloud_.size(), std::move(pairs)};
  }

 private:
  /// Eyes of the doubtful ones and of all they look at.
  void open_eyes(std::span<const std::int32_t> from, const std::vector<double>& sight) {
    std::vector<std::uint8_t> wanted(cloud_.X.size());
    for (const std::int32_t a : from)
      if (doubtful_[a])
        grid_.near(cloud_.X[a], sight[a], [&](std::int32_t b, double r) { wanted[b] |= r < sight[a]; });
    for_each_uneven(cloud_.size(), [&](std::int64_t a) {
      if (wanted[a] && !eyes_[a])
        eyes_[a] = eye_of(boundary_, scaling_.in(cloud_.X[a]), scaling_.in(cloud_.centroid[a]));
    });
  }

  const ParticleCloud& cloud_;
  Scaling scaling_;
  Boundary boundary_;
  PointGrid grid_;
  std::vector<std::uint8_t> doubtful_; ///< the body is not convex around it
  std::vector<std::optional<Eye>> eyes_;
  std::vector<std::vector<std::array<std::int32_t, 2>>> hidden_;
};

} // namespace

void look_around(const Domain& domain, int neighbours, double reach, ParticleCloud& cloud) {
  cloud.hidden = {};
  Lookout lookout(domain, cloud);
  std::vector<std::int32_t> from(cloud.X.size());
  std::iota(from.begin(), from.end(), 0);
  if (cloud.arrangement == "lattice") {
    cloud.sight.assign(cloud.X.size(), (reach > 0 ? reach : 3.2) * cloud.spacing);
    lookout.look(from, cloud.sight);
    cloud.hidden = lookout.hidden();
    return;
  }
  const double margin = reach > 0 ? reach : 1.5;
  const int others = static_cast<int>(std::min<std::int64_t>(neighbours, cloud.size() - 1));
  cloud.sight.assign(cloud.X.size(), 0);
  const double across = (domain.upper - domain.lower).norm(); // beyond which there is nobody to see
  // Whoever loses neighbours to a slot looks farther along its own side, which may reveal more of them.
  for (int round = 0; round < 4 && !from.empty(); ++round) {
    const std::vector<double> visible = distance_to_nearest(cloud.X, others, cloud.hidden, from);
    std::vector<std::int32_t> farther;
    for (std::size_t i = 0; i < from.size(); ++i)
      if (const double wanted = margin * std::min(visible[i], across); wanted > cloud.sight[from[i]]) {
        cloud.sight[from[i]] = wanted;
        farther.push_back(from[i]);
      }
    from = std::move(farther);
    lookout.look(from, cloud.sight);
    cloud.hidden = lookout.hidden();
    std::erase_if(from, [&](std::int32_t a) { return !cloud.hidden.any_of(a); });
  }
}

} // namespace tessera::preprocess

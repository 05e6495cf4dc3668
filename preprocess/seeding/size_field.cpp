#include "preprocess/seeding/size_field.hpp"

#include "core/error.hpp"
#include "core/particle_cloud.hpp"
#include "preprocess/seeding/box_tree.hpp"
#include "preprocess/seeding/nearness.hpp"
#include "preprocess/seeding/tet_locator.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

namespace tessera::preprocess {
namespace {

constexpr double smallest_size = 0.01;

[[noreturn]] void refuse_name(const Domain& domain, const std::string& name) {
  std::vector<std::string> known = domain.surfaces;
  for (const auto& group : domain.groups)
    known.push_back(group.name);
  const std::string nearest = nearest_name(name, known);
  throw InputError(fmt::format("\"{}\" is no set of the geometry file", name), "particles.refine",
                   fmt::format("{}those of [[set]] come too late for it; the file has: {}",
                               nearest.empty() ? "" : fmt::format("did you mean \"{}\"? ", nearest),
                               fmt::join(known, ", ")));
}

/// Points, segments and triangles of a set, all as triangles with repeated corners where they are less.
class Shape {
 public:
  Shape(const Domain& domain, const std::string& name) : Shape(parts_of(domain, name)) {}

  double distance(const Vec3& X) const {
    return std::sqrt(
        tree_
            .nearest(X, [&](std::int32_t k) { return (X - nearest_on_triangle(X, parts_[k])).squaredNorm(); })
            .second);
  }

 private:
  using Triangle = std::array<Vec3, 3>;
  explicit Shape(std::vector<Triangle> parts) : parts_(std::move(parts)), tree_(boxes_of(parts_)) {}

  static std::vector<Triangle> parts_of(const Domain& domain, const std::string& name) {
    std::vector<Triangle> parts;
    const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
      Triangle triangle{domain.vertices[a], domain.vertices[b], domain.vertices[c]};
      if (domain.dimension == 2 && a == c) // points and pieces of the upper rim: particles lie at z = 0
        for (Vec3& X : triangle)
          X.z() = 0;
      parts.push_back(triangle);
    };
    std::vector<bool> surface(domain.surfaces.size(), false);
    const auto group = std::find_if(domain.groups.begin(), domain.groups.end(),
                                    [&](const Domain::Group& g) { return g.name == name; });
    const auto itself = std::find(domain.surfaces.begin(), domain.surfaces.end(), name);
    if (group != domain.groups.end()) {
      require(group->dimension < 3, fmt::format("\"{}\" is the whole body", name), "particles.refine",
              "refine around a surface, curve or point, or choose a smaller spacing");
      for (const std::int32_t s : group->surfaces)
        surface[s] = true;
      for (const std::int32_t v : group->vertices)
        add(v, v, v);
      for (const auto& edge : domain.feature_edges)
        if (std::count(group->curves.begin(), group->curves.end(), edge.curve) > 0)
          add(edge.vertices[0], edge.vertices[1], edge.vertices[0]);
    } else if (itself != domain.surfaces.end()) {
      surface[itself - domain.surfaces.begin()] = true;
    } else {
      refuse_name(domain, name);
    }
    for (const auto& facet : domain.facets)
      if (facet.surface >= 0 && surface[facet.surface])
        add(facet.vertices[0], facet.vertices[1], facet.vertices[2]);
    return parts;
  }

  static std::vector<Box> boxes_of(const std::vector<Triangle>& parts) {
    std::vector<Box> boxes;
    boxes.reserve(parts.size());
    for (const auto& [a, b, c] : parts)
      boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
    return boxes;
  }

  std::vector<Triangle> parts_;
  BoxTree tree_;
};

/// Mean length of the edges around every vertex over the largest of them; in a slab, of the lids' triangles.
std::vector<double> sizes_at_vertices(const Domain& domain) {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  const auto add = [&](std::int32_t a, std::int32_t b) {
    edges.emplace_back(std::min(a, b), std::max(a, b));
  };
  if (domain.dimension == 2) {
    for (const auto& facet : domain.facets)
      for (int k = 0; k < 3 && facet.surface == Domain::lid; ++k)
        add(facet.vertices[k], facet.vertices[(k + 1) % 3]);
  } else {
    for (const auto& tet : domain.tets)
      for (int a = 0; a < 4; ++a)
        for (int b = a + 1; b < 4; ++b)
          add(tet[a], tet[b]);
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<double> size(domain.vertices.size(), 0);
  std::vector<int> count(domain.vertices.size(), 0);
  for (const auto& [a, b] : edges)
    for (const std::int32_t v : {a, b}) {
      size[v] += (domain.vertices[a] - domain.vertices[b]).norm();
      ++count[v];
    }
  double largest = 0;
  for (std::size_t v = 0; v < size.size(); ++v) {
    size[v] /= std::max(count[v], 1);
    largest = std::max(largest, size[v]);
  }
  for (double& s : size)
    s = std::max(s / largest, smallest_size);
  return size;
}

class MeshSizes {
 public:
  explicit MeshSizes(const Domain& domain)
      : domain_(&domain), at_vertex_(sizes_at_vertices(domain)), locator_(domain, domain.vertices) {}

  double operator()(const Vec3& X) const {
    const std::int32_t t = locator_.nearest(X);
    Eigen::Vector4d w = locator_.weights(t, X).cwiseMax(0);
    w /= w.sum();
    double size = 0;
    for (int k = 0; k < 4; ++k)
      size += w[k] * at_vertex_[domain_->tets[t][k]];
    return size;
  }

 private:
  const Domain* domain_;
  std::vector<double> at_vertex_;
  TetLocator locator_;
};

/// One refinement with what it needs to know distances.
struct Around {
  Refinement what;
  std::optional<Shape> shape; ///< of a named set

  double operator()(const Vec3& X) const {
    const double distance = shape ? shape->distance(X) : (X - std::get<Vec3>(what.around)).norm();
    if (distance <= what.within)
      return what.factor;
    if (distance >= what.until)
      return 1;
    return what.factor + (1 - what.factor) * (distance - what.within) / (what.until - what.within);
  }
};

struct Field {
  std::vector<Around> around;
  std::optional<MeshSizes> mesh;

  double operator()(const Vec3& X) const {
    double size = mesh ? (*mesh)(X) : 1;
    for (const Around& refinement : around)
      size = std::min(size, refinement(X));
    return size;
  }
};

void check(const Refinement& refinement) {
  require(refinement.factor >= smallest_size && refinement.factor <= 1,
          fmt::format("factor = {:.3g} is out of range", refinement.factor), "particles.refine",
          fmt::format("choose a fraction of the spacing from {} to 1", smallest_size));
  const double within = refinement.within, until = refinement.until;
  require(within >= 0 && until >= within && std::isfinite(until),
          fmt::format("within = {:.3g} m and until = {:.3g} m are no distances in ascending order", within,
                      until),
          "particles.refine", "give 0 <= within <= until");
  if (const Vec3* point = std::get_if<Vec3>(&refinement.around))
    require(point->allFinite(), "the point is not finite", "particles.refine",
            "give finite coordinates in m");
}

} // namespace

/// A refinement that reaches no part of the body is a slip, most often of units.
void require_reach(const Domain& domain, const Refinement& refinement) {
  const Vec3* point = std::get_if<Vec3>(&refinement.around);
  if (point == nullptr)
    return;
  const double beyond = (domain.lower - *point).cwiseMax(*point - domain.upper).cwiseMax(0.0).norm();
  require(beyond < refinement.until,
          fmt::format("the refinement around ({:g}, {:g}, {:g}) m ends {:.3g} m short of the body",
                      (*point)[0], (*point)[1], (*point)[2], beyond - refinement.until),
          "particles.refine", "refinements are in metres, whatever the unit of the file: move the point");
}

SizeField size_field(const Domain& domain, const std::vector<Refinement>& refine, bool sizes_from_mesh) {
  if (refine.empty() && !sizes_from_mesh)
    return {};
  const auto field = std::make_shared<Field>();
  for (Refinement refinement : refine) {
    check(refinement);
    if (Vec3* point = std::get_if<Vec3>(&refinement.around); point != nullptr && domain.dimension == 2)
      point->z() = 0;
    require_reach(domain, refinement);
    Around& around = field->around.emplace_back(Around{refinement, std::nullopt});
    if (const auto* name = std::get_if<std::string>(&refinement.around))
      around.shape.emplace(domain, *name);
  }
  if (sizes_from_mesh)
    field->mesh.emplace(domain);
  return [field](const Vec3& X) { return (*field)(X); };
}

} // namespace tessera::preprocess

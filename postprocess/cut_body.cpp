#include "postprocess/cut_body.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace tessera::post {
namespace {

class Cutter {
 public:
  Cutter(const BodyMesh& mesh, std::span<const double> values, const CutPlane& plane)
      : mesh_(mesh), values_(values), plane_(plane) {
    for (const Vec3& x : mesh.points)
      beyond_.push_back(plane.beyond(x));
  }

  CutBody operator()() {
    for (const auto& face : mesh_.faces)
      add_face(face);
    for (const auto& solid : mesh_.solids)
      add_section(solid);
    for (const auto& [a, b] : mesh_.edges)
      if (stays(a) || stays(b))
        out_.edges.push_back({stays(a) ? corner(a) : crossing(a, b), stays(b) ? corner(b) : crossing(a, b)});
    return std::move(out_);
  }

 private:
  bool stays(std::int32_t p) const { return beyond_[p] >= 0; }

  std::int32_t corner(std::int32_t p) {
    return place(p, p, [&] { return std::pair(mesh_.points[p], values_.empty() ? 0 : values_[p]); });
  }

  /// Where the edge between a point that stays and one that does not meets the plane.
  std::int32_t crossing(std::int32_t a, std::int32_t b) {
    const auto [low, high] = std::minmax(a, b);
    return place(low, high, [&, low = low, high = high] {
      const double t = beyond_[low] / (beyond_[low] - beyond_[high]);
      return std::pair<Vec3, double>((1 - t) * mesh_.points[low] + t * mesh_.points[high],
                                     values_.empty() ? 0 : (1 - t) * values_[low] + t * values_[high]);
    });
  }

  template <class Make>
  std::int32_t place(std::int32_t a, std::int32_t b, Make&& make) {
    const auto [found, fresh] = placed_.try_emplace({a, b}, static_cast<std::int32_t>(out_.points.size()));
    if (fresh) {
      const auto [x, value] = make();
      out_.points.push_back(x);
      if (!values_.empty())
        out_.values.push_back(value);
    }
    return found->second;
  }

  void add_face(const std::array<std::int32_t, 3>& face) {
    CutBody::Polygon polygon, cut;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = face[k], b = face[(k + 1) % 3];
      if (stays(a))
        polygon.push_back(corner(a));
      if (stays(a) != stays(b)) {
        cut.push_back(crossing(a, b));
        polygon.push_back(cut.back());
      }
    }
    if (!polygon.empty())
      out_.skin.push_back(std::move(polygon));
    if (cut.size() == 2)
      out_.rim.push_back({cut[0], cut[1]});
  }

  void add_section(const std::array<std::int32_t, 4>& solid) {
    std::array<std::int32_t, 4> order = solid;
    const auto gone = std::stable_partition(order.begin(), order.end(), [&](auto p) { return stays(p); });
    const auto& [a, b, c, d] = order;
    switch (gone - order.begin()) {
    case 1:
      out_.section.push_back({crossing(a, b), crossing(a, c), crossing(a, d)});
      break;
    case 2:
      out_.section.push_back({crossing(a, c), crossing(a, d), crossing(b, d), crossing(b, c)});
      break;
    case 3:
      out_.section.push_back({crossing(a, d), crossing(b, d), crossing(c, d)});
      break;
    default:
      break;
    }
  }

  const BodyMesh& mesh_;
  std::span<const double> values_;
  CutPlane plane_;
  std::vector<double> beyond_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> placed_;
  CutBody out_;
};

} // namespace

CutBody cut_body(const BodyMesh& mesh, std::span<const double> values, const CutPlane& plane) {
  return Cutter(mesh, values, plane)();
}

CutBody whole_body(const BodyMesh& mesh, std::span<const double> values) {
  CutBody whole{mesh.points, {values.begin(), values.end()}, {}, {}, mesh.edges, {}};
  for (const auto& face : mesh.faces)
    whole.skin.emplace_back(face.begin(), face.end());
  return whole;
}

} // namespace tessera::post

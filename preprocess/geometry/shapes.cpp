#include "preprocess/geometry/shapes.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tessera::preprocess {
namespace {

constexpr double largest_ratio = 1e5; // of lengths: OpenCASCADE's tolerance is absolute

[[noreturn]] void refuse(const std::string& what, const std::string& key, const std::string& remedy) {
  throw InputError(what, "[geometry] " + key, remedy);
}

/// Relations between the lengths of one shape, `l` in the order of its kind.
void check_relations(const ShapeSpec& shape) {
  const auto& l = shape.lengths;
  if (shape.name == "tube" || shape.name == "ring") {
    if (!(l[1][0] < l[0][0]))
      refuse(fmt::format("the inner radius {:g} m is not smaller than the outer radius {:g} m", l[1][0],
                         l[0][0]),
             "inner_radius", "give a smaller one");
  } else if (shape.name == "plate_with_hole") {
    const double across = std::min(l[0][0], l[0][1]);
    if (!(2 * l[1][0] < across))
      refuse(fmt::format("a hole of diameter {:g} m does not fit into a plate of {:g} m by {:g} m",
                         2 * l[1][0], l[0][0], l[0][1]),
             "hole_radius", fmt::format("give less than {:g}", across / 2));
  } else if (shape.name == "l_part" || shape.name == "t_part") {
    const double across = std::min(l[0][0], l[0][1]);
    if (!(l[1][0] < across))
      refuse(fmt::format("a thickness of {:g} m leaves nothing of a profile of {:g} m by {:g} m", l[1][0],
                         l[0][0], l[0][1]),
             "thickness", fmt::format("give less than {:g}", across));
  }
}

} // namespace

const std::vector<ShapeKind>& known_shapes() {
  static const std::vector<std::string> box{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
  static const std::vector<std::string> rectangle{"left", "right", "bottom", "top"};
  static const auto with = [](std::vector<std::string> names, std::initializer_list<std::string> more) {
    names.insert(names.end(), more);
    return names;
  };
  static const std::vector<ShapeKind> kinds{
      {"box", 3, {{"size", 3}}, box},
      {"cylinder", 3, {{"radius", 1}, {"height", 1}}, {"bottom", "top", "side"}},
      {"sphere", 3, {{"radius", 1}}, {"side"}},
      {"tube",
       3,
       {{"outer_radius", 1}, {"inner_radius", 1}, {"height", 1}},
       {"bottom", "top", "side", "bore"}},
      {"plate_with_hole", 3, {{"size", 3}, {"hole_radius", 1}}, with(box, {"hole"})},
      {"l_part", 3, {{"size", 3}, {"thickness", 1}}, with(box, {"inner_x", "inner_y"})},
      {"t_part", 3, {{"size", 3}, {"thickness", 1}}, with(box, {"web_left", "web_right", "flange_under"})},
      {"rectangle", 2, {{"size", 2}}, rectangle},
      {"disc", 2, {{"radius", 1}}, {"side"}},
      {"ring", 2, {{"outer_radius", 1}, {"inner_radius", 1}}, {"side", "bore"}},
      {"plate_with_hole", 2, {{"size", 2}, {"hole_radius", 1}}, with(rectangle, {"hole"})},
      {"l_part", 2, {{"size", 2}, {"thickness", 1}}, with(rectangle, {"inner_x", "inner_y"})},
      {"t_part",
       2,
       {{"size", 2}, {"thickness", 1}},
       with(rectangle, {"web_left", "web_right", "flange_under"})},
  };
  return kinds;
}

const ShapeKind& shape_kind(const std::string& name, int dimension) {
  std::string known;
  for (const ShapeKind& kind : known_shapes()) {
    if (kind.dimension != dimension)
      continue;
    if (kind.name == name)
      return kind;
    known += (known.empty() ? "" : ", ") + kind.name;
  }
  refuse(fmt::format("there is no shape \"{}\" of dimension {}", name, dimension), "shape",
         fmt::format("give one of {}", known));
}

void check_shape(const ShapeSpec& shape, int dimension) {
  const ShapeKind& kind = shape_kind(shape.name, dimension);
  if (shape.lengths.size() != kind.lengths.size())
    refuse(
        fmt::format("a {} takes {} lengths, not {}", shape.name, kind.lengths.size(), shape.lengths.size()),
        "shape", "give each of them once");
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t i = 0; i < kind.lengths.size(); ++i) {
    const auto& [key, components] = kind.lengths[i];
    if (shape.lengths[i].size() != static_cast<std::size_t>(components))
      refuse(fmt::format("{} has {} number{}, not {}", key, shape.lengths[i].size(),
                         shape.lengths[i].size() == 1 ? "" : "s", components),
             key,
             fmt::format("give {} in metres", components == 1 ? "one length" : "a length for each axis"));
    for (const double length : shape.lengths[i]) {
      if (!(std::isfinite(length) && length > 0))
        refuse(fmt::format("{} is {:g}, not a positive length", key, length), key, "give metres");
      least = std::min(least, length);
      most = std::max(most, length);
    }
  }
  if (!(most <= largest_ratio * least))
    refuse(fmt::format("lengths of {:g} m and {:g} m in one {} are too far apart", least, most, shape.name),
           "shape", fmt::format("keep them within a factor of {:g}", largest_ratio));
  check_relations(shape);
}

} // namespace tessera::preprocess

#include "app/case/read_wall.hpp"

#include "app/case/read_cloud.hpp"
#include "core/error.hpp"
#include "solver/boundary/plane.hpp"
#include "solver/boundary/polyline.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <string>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;
using solver::ContactMethod, solver::WallSpec;

constexpr Range spring_stiffness{[](double x) { return x > 0 && x <= 10; }, "greater than 0 and at most 10"};

std::shared_ptr<const RigidShape> read_plane(Table plane, int dimension) {
  const Vec3 point = plane.vector("point"), normal = plane.vector("normal");
  plane.finish();
  if (normal.isZero())
    plane.refuse("normal", "the wall's normal is zero", "point it to the body's side");
  if (dimension == 2 && normal[2] != 0)
    plane.refuse("normal", "the wall's normal leaves the plane of the body", "let its z be 0");
  return std::make_shared<const solver::Plane>(point, normal, plane.where());
}

solver::Channel read_channel(Table channel) {
  const std::vector<Vec<2>> path = channel.points("path");
  const double width = channel.number("width", positive);
  const double outer = channel.number_or("outer_fillet", 0, not_negative),
               inner = channel.number_or("inner_fillet", 0, not_negative);
  channel.finish();
  return solver::channel(path, width, outer, inner, channel.where());
}

std::shared_ptr<const RigidShape> read_polyline(Table line) {
  const std::vector<Vec<2>> points = line.points("points");
  std::vector<double> fillets;
  if (line.has("fillets"))
    fillets = line.number_list("fillets");
  else
    line.allow("fillets");
  line.finish();
  return std::make_shared<const solver::Polyline>(points, std::move(fillets), line.where());
}

/// How the body is treated, whatever the shape.
WallSpec read_contact(Table& table, int dimension, const std::string& default_name) {
  WallSpec wall;
  wall.shape = nullptr;
  wall.name = default_name;
  if (table.has("name"))
    wall.name = table.name("name");
  else
    table.allow("name");
  wall.friction = table.number_or("friction", wall.friction, not_negative);
  wall.restitution = table.number_or("restitution", wall.restitution, zero_to_one);
  wall.method = table.choice_or("method", "reflection", {"reflection", "penalty"}) == "penalty"
                    ? ContactMethod::penalty
                    : ContactMethod::reflection;
  wall.stiffness = table.number_or("stiffness", wall.stiffness, spring_stiffness);
  wall.velocity = table.optional_vector("velocity").value_or(wall.velocity);
  if (table.has("stiffness") && wall.method != ContactMethod::penalty)
    table.refuse("stiffness",
                 fmt::format("{} does nothing to a wall that reflects", table.path_of("stiffness")),
                 "remove it or set method = \"penalty\"");
  if (dimension == 2 && wall.velocity[2] != 0)
    table.refuse("velocity", "the wall's velocity leaves the plane of the body", "let its z be 0");
  return wall;
}

void read_wall(Table table, int dimension, const fs::path& case_folder, std::size_t entry, Walls& result) {
  WallSpec wall = read_contact(table, dimension, fmt::format("wall_{}", entry + 1));
  const auto plane = table.optional_table("plane"), channel = table.optional_table("channel"),
             polyline = table.optional_table("polyline"), surface = table.optional_table("surface");
  table.finish();

  std::vector<std::string> shapes;
  for (const char* key : {"plane", "channel", "polyline", "surface"})
    if (table.has(key))
      shapes.push_back(key);
  if (shapes.size() != 1)
    throw InputError(shapes.empty() ? std::string("a [[wall]] entry has no shape")
                                    : fmt::format("a [[wall]] entry has {}", fmt::join(shapes, " and ")),
                     table.where(), "give exactly one of plane, channel, polyline and surface");
  const bool of_the_plane = channel || polyline;
  if (of_the_plane && dimension == 3)
    table.refuse(shapes[0], fmt::format("a {} meets plane bodies only", shapes[0]),
                 "use plane or surface, or geometry.dimension = 2");
  if (surface && dimension == 2)
    table.refuse("surface", "a surface meets bodies in space only", "use plane, channel or polyline");

  const auto add = [&](std::shared_ptr<const RigidShape> shape, const char* suffix) {
    WallSpec one = wall;
    one.name += suffix;
    one.shape = std::move(shape);
    for (const WallSpec& other : result.walls)
      if (other.name == one.name)
        table.refuse("name", fmt::format("two walls are called '{}'", one.name), "give each its own name");
    result.walls.push_back(std::move(one));
  };
  if (plane)
    add(read_plane(*plane, dimension), "");
  if (polyline)
    add(read_polyline(*polyline), "");
  if (channel) {
    const auto [left, right] = read_channel(*channel);
    add(left, "_left");
    add(right, "_right");
  }
  if (surface) {
    preprocess::GeometrySource source = read_geometry(*surface, case_folder);
    if (source.dimension != 3)
      surface->refuse("dimension", fmt::format("{} is {}", surface->path_of("dimension"), source.dimension),
                      "a wall's surface encloses a volume: leave it out");
    result.surfaces.push_back({entry, result.walls.size(), std::move(source)});
    add(nullptr, "");
  }
}

} // namespace

Walls read_walls(const std::vector<Table>& entries, int dimension, const fs::path& case_folder) {
  Walls result;
  for (std::size_t i = 0; i < entries.size(); ++i)
    read_wall(entries[i], dimension, case_folder, i, result);
  return result;
}

} // namespace tessera::app

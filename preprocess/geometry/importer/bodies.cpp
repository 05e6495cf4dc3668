#include "preprocess/geometry/importer/bodies.hpp"

#include "core/error.hpp"
#include "preprocess/geometry/importer/gmsh_session.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>

namespace tessera::importer {

std::size_t choose_body(const std::vector<Candidate>& candidates, const Request& request,
                        const std::string& noun) {
  const std::size_t count = candidates.size();
  if (request.solid > 0) {
    require(static_cast<std::size_t>(request.solid) <= count,
            fmt::format("[geometry] solid is {}, but there {} {} {}{} in the file", request.solid,
                        count == 1 ? "is" : "are", count, noun, count == 1 ? "" : "s"),
            request.name, fmt::format("give a number from 1 to {}", count));
    return static_cast<std::size_t>(request.solid) - 1;
  }
  if (count == 1)
    return 0;
  constexpr std::size_t most_listed = 4;
  std::string list;
  for (std::size_t c = 0; c < std::min(count, most_listed); ++c) {
    const Candidate& body = candidates[c];
    list +=
        fmt::format("{} {}{}", c == 0 ? ":" : ";", c + 1, body.name.empty() ? "" : " \"" + body.name + '"');
    if (std::isfinite(body.measure)) // gmsh's own kernel does not say
      list += fmt::format(" of {} {:.4g}", request.dimension == 2 ? "area" : "volume", body.measure);
    list += fmt::format(" from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})", body.lower[0],
                        body.lower[1], body.lower[2], body.upper[0], body.upper[1], body.upper[2]);
  }
  if (count > most_listed)
    list += fmt::format("; and {} more", count - most_listed);
  throw InputError(fmt::format("there are {} {}s in the file{} in its unit", count, noun, list), request.name,
                   "choose one with [geometry] solid = N, or unite them");
}

std::optional<double> kernel_measure(int dimension, int tag) {
  gmsh::vectorpair entities;
  gmsh::model::occ::getEntities(entities, dimension);
  if (std::find(entities.begin(), entities.end(), std::pair{dimension, tag}) == entities.end())
    return {};
  double measure = 0;
  gmsh::model::occ::getMass(dimension, tag, measure);
  return std::abs(measure);
}

int choose_solid(const Request& request) {
  const auto solids = tags_of(3);
  const std::size_t surfaces = tags_of(2).size();
  require(!solids.empty() || surfaces > 0, "there is no body in the file", request.name, "export a solid");
  require(!solids.empty(),
          fmt::format("there is no solid in the file, only {} surface{} without a volume", surfaces,
                      surfaces == 1 ? "" : "s"),
          request.name,
          "join them to a solid in the CAD program, or set [geometry] dimension = 2 for a plane body");
  std::vector<Candidate> candidates;
  for (const int solid : solids) {
    Candidate body{{}, kernel_measure(3, solid).value_or(std::nan("")), {}, {}};
    gmsh::model::getBoundingBox(3, solid, body.lower[0], body.lower[1], body.lower[2], body.upper[0],
                                body.upper[1], body.upper[2]);
    gmsh::model::getEntityName(3, solid, body.name);
    if (const auto slash = body.name.rfind('/'); slash != std::string::npos)
      body.name.erase(0, slash + 1); // "Shapes/Assembly/Part"
    candidates.push_back(std::move(body));
  }
  const int chosen = solids[choose_body(candidates, request, "solid")];
  show_only(3, {chosen});
  return chosen;
}

void show_only(int dimension, const std::vector<int>& tags) {
  gmsh::vectorpair all, shown;
  gmsh::model::getEntities(all);
  gmsh::model::setVisibility(all, 0);
  for (const int tag : tags)
    shown.emplace_back(dimension, tag);
  gmsh::model::setVisibility(shown, 1, true);
}

} // namespace tessera::importer

#include "preprocess/geometry/importer/tessellate.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>

namespace tessera::importer {
namespace {

constexpr double first_segments = 24, most_segments = 4000; // edges a full turn
constexpr std::size_t most_triangles = 4'000'000;
constexpr double planar = 1e-12; // two tessellations closer than this are of a body with planar faces

} // namespace

Tessellation tessellate(std::optional<double> exact, double size, const FileSizes& file,
                        const Request& request, const std::function<double()>& measure) {
  // gmsh's own kernel hangs in curvature sizing (4.8.4): its surfaces are refined all over. So are those that
  // follow the file's sizes, to keep their proportions.
  const bool by_curvature = exact && !request.background_sizes;
  const auto mesh = [&](double segments) {
    const double finer = first_segments / segments;
    Sizes sizes{.largest = size};
    if (by_curvature)
      sizes = {.largest = size, .smallest = 0.1 * size * finer, .segments = segments};
    else if (request.background_sizes)
      sizes = {.largest = size, .factor = finer, .from_file = true};
    else
      sizes.largest *= finer;
    sizes.extend = request.dimension == 3; // a plane figure may be coarse inside
    gmsh::model::mesh::clear();
    set_sizes(sizes, file);
    gmsh::model::mesh::generate(2);
    if (const std::string complaint = first_complaint(); !complaint.empty())
      throw InputError(fmt::format("a surface cannot be meshed: {}", complaint), request.name,
                       "heal the part in the CAD program");
    std::vector<std::size_t> tags, nodes;
    gmsh::model::mesh::getElementsByType(2, tags, nodes);
    require(tags.size() < most_triangles,
            fmt::format("the surfaces take more than {} triangles", most_triangles), request.name,
            "ask for a looser [geometry] tolerance or larger mesh sizes");
    const double found = measure();
    require(found > 0, request.dimension == 2 ? "the figure has no area" : "the solid has no volume",
            request.name, "give a closed body");
    return Tessellation{found, found, sizes};
  };

  double segments = first_segments, error = 1;
  Tessellation now = mesh(segments);
  for (;;) {
    if (exact) {
      now.cad_measure = *exact;
    } else {
      // Chordal error falls with the square of the edge, so two meshes tell where it goes.
      const double coarser = now.mesh_measure;
      segments *= 2;
      now = mesh(segments);
      const double change = now.mesh_measure - coarser;
      now.cad_measure = now.mesh_measure + (std::abs(change) < planar * now.mesh_measure ? 0.0 : change / 3);
    }
    error = std::abs(now.mesh_measure - now.cad_measure) / std::abs(now.cad_measure);
    if (error < request.tolerance)
      return now;
    if (segments >= most_segments)
      break;
    if (exact) {
      const double next = segments * std::clamp(1.05 * std::sqrt(error / request.tolerance), 1.2, 8.0);
      segments = std::min(std::ceil(next), most_segments);
      now = mesh(segments);
    }
  }
  throw InputError(fmt::format("the mesh stays {:.2g} off the {} by the CAD, more than the tolerance {:.2g}",
                               error, request.dimension == 2 ? "area" : "volume", request.tolerance),
                   request.name, "ask for a looser [geometry] tolerance or heal the part");
}

} // namespace tessera::importer

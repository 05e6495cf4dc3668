#include "preprocess/geometry/importer/gmsh_session.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <utility>

namespace tessera::importer {
namespace {

constexpr std::size_t most_tetrahedra = 5'000'000;

void set_options(std::initializer_list<std::pair<const char*, double>> options) {
  for (const auto& [option, value] : options)
    gmsh::option::setNumber(option, value);
}

} // namespace

Gmsh::Gmsh() {
  gmsh::initialize(0, nullptr, false);
  set_options({{"General.NumThreads", 1},
               {"Mesh.MaxNumThreads1D", 1},
               {"Mesh.MaxNumThreads2D", 1},
               {"Mesh.MaxNumThreads3D", 1},
               {"General.Terminal", 1},
               {"General.AbortOnError", 0}});
  gmsh::logger::start();
}

Gmsh::~Gmsh() {
  gmsh::finalize();
}

std::string first_complaint() {
  std::vector<std::string> lines;
  gmsh::logger::get(lines);
  gmsh::logger::stop();
  gmsh::logger::start();
  constexpr std::string_view prefix = "Error: ";
  for (const std::string& line : lines)
    if (line.starts_with(prefix))
      return line.substr(prefix.size());
  return {};
}

void open_file(const std::string& file, const std::string& name) {
  std::string complaint;
  try {
    gmsh::open(file);
  } catch (const std::string& error) {
    complaint = error;
  }
  if (const std::string logged = first_complaint(); !logged.empty())
    complaint = logged;
  // The message names the link we gave gmsh; the user knows the file by its own name, which is there as well.
  if (const auto at = complaint.find(file); at != std::string::npos)
    complaint.replace(at, file.size(), "file");
  require(complaint.empty(), fmt::format("gmsh cannot read the file: {}", complaint), name,
          "repair or export it again");
}

std::vector<int> tags_of(int dimension) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  std::vector<int> tags;
  for (const auto& entity : entities)
    tags.push_back(entity.second);
  std::sort(tags.begin(), tags.end());
  return tags;
}

FileSizes sizes_in_file() {
  FileSizes sizes{};
  gmsh::option::getNumber("Mesh.MeshSizeFromPoints", sizes.from_points);
  gmsh::option::getNumber("Mesh.MeshSizeExtendFromBoundary", sizes.extend);
  gmsh::option::getNumber("Mesh.MeshSizeMin", sizes.smallest);
  gmsh::option::getNumber("Mesh.MeshSizeMax", sizes.largest);
  return sizes;
}

void set_sizes(const Sizes& sizes, const FileSizes& file) {
  const bool own = sizes.from_file;
  set_options({{"Mesh.MeshSizeMin", own ? file.smallest : sizes.smallest},
               {"Mesh.MeshSizeMax", own ? std::min(sizes.largest, file.largest) : sizes.largest},
               {"Mesh.MeshSizeFactor", sizes.factor},
               {"Mesh.MeshSizeFromPoints", own ? file.from_points : 0},
               {"Mesh.MeshSizeFromCurvature", sizes.segments},
               {"Mesh.MeshSizeExtendFromBoundary", own ? file.extend : (sizes.extend ? 1 : 0)},
               {"Mesh.ElementOrder", 1},
               {"Mesh.RecombineAll", 0},
               {"Mesh.SubdivisionAlgorithm", 0},
               {"Mesh.Algorithm", 6},
               {"Mesh.RandomSeed", 1},
               {"Mesh.SaveAll", 0},
               {"Mesh.SecondOrderIncomplete", 0},
               {"Mesh.MeshOnlyVisible", 1},
               {"Mesh.RandomFactor", 1e-9},
               {"Mesh.RandomFactor3D", 1e-12},
               {"Mesh.MeshOnlyEmpty", 0}});
}

void fill_volume(const Sizes& sizes, const FileSizes& file, const std::string& name) {
  set_sizes(sizes, file);
  // Without sizes inside, the constrained Delaunay tetrahedra of the surface's own vertices (3): two to three
  // times slower than HXT, but HXT's result depends on where the system happens to put its memory, and has
  // flat tetrahedra. With sizes, points are added to it (1), no more than five million tetrahedra need.
  set_options({{"Mesh.Algorithm3D", sizes.from_file ? 1 : 3},
               {"Mesh.MaxIterDelaunay3D", static_cast<double>(most_tetrahedra) / 5},
               {"Mesh.Optimize", 0},
               {"Mesh.OptimizeNetgen", 0}});
  gmsh::model::mesh::generate(3);
  std::vector<std::size_t> tags, nodes;
  gmsh::model::mesh::getElementsByType(4, tags, nodes);
  require(tags.size() < most_tetrahedra,
          fmt::format("the mesh takes more than {} tetrahedra", most_tetrahedra), name,
          sizes.from_file ? "ask for larger mesh sizes in the .geo file or a looser [geometry] tolerance"
                          : "ask for a looser [geometry] tolerance");
}

std::vector<PhysicalGroup> physical_groups() {
  gmsh::vectorpair physicals;
  gmsh::model::getPhysicalGroups(physicals);
  std::vector<PhysicalGroup> groups;
  for (const auto& [dimension, physical] : physicals) {
    PhysicalGroup group{dimension, "", {}};
    gmsh::model::getPhysicalName(dimension, physical, group.name);
    if (group.name.empty())
      group.name = fmt::format("physical{}", physical);
    gmsh::model::getEntitiesForPhysicalGroup(dimension, physical, group.entities);
    std::sort(group.entities.begin(), group.entities.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

void require_first_order(int dimension, const std::string& name) {
  const bool plane = dimension == 2;
  const int wanted = plane ? 2 : 4; // gmsh's numbers of the element types
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, dimension);
  for (const int type : types)
    if (type != wanted) {
      std::string kind;
      int of_dimension, order, nodes, primary;
      std::vector<double> local;
      gmsh::model::mesh::getElementProperties(type, kind, of_dimension, order, nodes, local, primary);
      throw InputError(fmt::format("the mesh has elements of type {}; only {} are read", kind,
                                   plane ? "three-node triangles" : "four-node tetrahedra"),
                       name, fmt::format("save it with first-order {}", plane ? "triangles" : "tetrahedra"));
    }
  require(!types.empty(), fmt::format("there are no {} in the mesh", plane ? "triangles" : "tetrahedra"),
          name,
          plane ? "mesh the plane surface, and save all of it: where there are physical groups gmsh saves "
                  "those only (Mesh.SaveAll = 1)"
                : "mesh the volume, not only the surface, and save all of it (Mesh.SaveAll = 1)");
}

} // namespace tessera::importer

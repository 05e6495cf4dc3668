/// gmsh started, fed and asked to mesh.
#pragma once

#include <string>
#include <vector>

namespace tessera::importer {

/// Starts gmsh with one thread, no configuration files and fixed seeds: same file, same bits.
class Gmsh {
 public:
  Gmsh();
  ~Gmsh();
  Gmsh(const Gmsh&) = delete;
  Gmsh& operator=(const Gmsh&) = delete;
};

/// Opens a file; InputError with gmsh's own first complaint when it has any.
void open_file(const std::string& file, const std::string& name);

/// First error gmsh has logged since it was last asked, without its prefix; empty when there was none.
std::string first_complaint();

/// Tags of the model's entities of one dimension, ascending.
std::vector<int> tags_of(int dimension);

/// A physical group of the file.
struct PhysicalGroup {
  int dimension;
  std::string name;          ///< "physical7" where the file names none
  std::vector<int> entities; ///< tags, ascending
};
std::vector<PhysicalGroup> physical_groups();

/// Throws InputError unless the mesh has elements of a dimension, all of them of the first order: three-node
/// triangles in the plane, four-node tetrahedra in space.
void require_first_order(int dimension, const std::string& name);

/// How long the edges of a mesh are to be.
struct Sizes {
  double largest;
  double smallest = 0;    ///< not even the tip of a cone, which has no radius, goes below
  double segments = 0;    ///< edges a full turn on curved entities; 0: curvature plays no part
  bool extend = true;     ///< edges inside as long as those of the boundary nearby
  double factor = 1;      ///< on all sizes, in the end
  bool from_file = false; ///< sizes of the file's points and background field count
};

/// What a .geo file itself says of its sizes.
struct FileSizes {
  double from_points, extend, smallest, largest;
};
FileSizes sizes_in_file();

void set_sizes(const Sizes& sizes, const FileSizes& file);

/// Meshes the volume between the surface triangles that are there: coarse inside, or as the file says. Throws
/// InputError when that takes more than five million tetrahedra.
void fill_volume(const Sizes& sizes, const FileSizes& file, const std::string& name);

} // namespace tessera::importer

/// tessera-import: reads one CAD or mesh file with gmsh and OpenCASCADE and writes a Domain. Started by
/// preprocess/geometry/import.cpp, which limits its time and memory and turns its end, whatever it be, into a
/// message.
///
///     tessera-import KEY=VALUE...
///
/// with the members of importer/request.hpp. Exit status: 0 with the domain in the file `output`, 2 with a
/// last line on standard error that begins with "tessera-import: ", 3 out of memory, 4 the output cannot be
/// written.

#include "core/error.hpp"
#include "preprocess/geometry/cad_file.hpp"
#include "preprocess/geometry/domain_stream.hpp"
#include "preprocess/geometry/importer/gmsh_session.hpp"
#include "preprocess/geometry/importer/import_file.hpp"
#include "preprocess/geometry/shapes.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <new>
#include <string>

namespace {

using namespace tessera;

preprocess::Domain import(const importer::Request& request) {
  const bool plane = request.dimension == 2;
  if (request.shape)
    return plane ? importer::import_plane_cad(request) : importer::import_cad(request);
  const auto format = preprocess::check_cad_file(request.file);
  if (preprocess::is_triangle_surface(format))
    return importer::import_surface(request);
  if (format == preprocess::CadFormat::msh)
    return plane ? importer::import_plane_mesh(request) : importer::import_mesh(request);
  return plane ? importer::import_plane_cad(request) : importer::import_cad(request);
}

/// Lengths in metres from here on (but for the thickness of a slab).
void to_metres(preprocess::Domain& domain, double metres) {
  const bool plane = domain.dimension == 2, own_reference = domain.cad_volume == domain.volume;
  for (Vec3& X : domain.vertices)
    X = X.cwiseProduct(Vec3(metres, metres, plane ? 1.0 : metres));
  domain.measure();
  domain.cad_volume =
      own_reference ? domain.volume : domain.cad_volume * metres * metres * (plane ? 1.0 : metres);
}

/// A group for each name of a surface, in the order of `names`.
void group_by_name(preprocess::Domain& domain, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto same = [&](const auto& group) { return group.name == name; };
    if (std::any_of(domain.groups.begin(), domain.groups.end(), same))
      continue;
    preprocess::Domain::Group group{name, 2, {}, {}, {}};
    for (std::size_t s = 0; s < domain.surfaces.size(); ++s)
      if (domain.surfaces[s] == name)
        group.surfaces.push_back(static_cast<std::int32_t>(s));
    domain.groups.push_back(std::move(group));
  }
}

int fail(int status, const std::string& message) {
  std::fflush(stdout);
  std::cerr << "\ntessera-import: " << message << std::endl;
  return status;
}

} // namespace

#ifdef __SANITIZE_ADDRESS__
/// OpenCASCADE keeps what it has read until the process ends; that is no leak of ours.
extern "C" const char* __asan_default_options() {
  return "detect_leaks=0";
}
#endif

int main(int argc, char** argv) {
  std::string name;
  try {
    const auto request = importer::from_arguments({argv + 1, argv + argc});
    name = request.name;
    preprocess::Domain domain;
    {
      const importer::Gmsh gmsh;
      domain = import(request);
    }
    to_metres(domain, request.metres);
    if (request.shape)
      group_by_name(domain, preprocess::shape_kind(request.shape->name, request.dimension).surfaces);
    else if (domain.groups.empty())
      group_by_name(domain, domain.surfaces);
    domain.validate(request.name);
    const std::string bytes = preprocess::to_bytes(domain);
    std::ofstream out(request.output, std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    return out ? 0 : fail(4, "the result cannot be written");
  } catch (const std::bad_alloc&) {
    return fail(3, "out of memory");
  } catch (const std::exception& error) {
    return fail(2, error.what());
  } catch (const std::string& error) {
    return fail(2, name + ": " + error);
  } catch (const char* error) {
    return fail(2, name + ": " + error);
  } catch (int error) {
    return fail(2, name + ": gmsh gave up with code " + std::to_string(error));
  }
}

/// tessera-import: reads one CAD or mesh file with gmsh and OpenCASCADE and writes a Domain. Started by
/// preprocess/geometry/import.cpp, which limits its time and memory and turns its end, whatever it be, into a
/// message.
///
///     tessera-import FILE NAME UNIT STEP_UNIT TOLERANCE MESH_SIZE OUTPUT
///
/// FILE is opened, NAME is what messages call it, UNIT is metres per unit of the numbers, STEP_UNIT the unit
/// OpenCASCADE converts STEP lengths to ("-" for other formats), MESH_SIZE is in metres. Exit status: 0 with
/// the domain in OUTPUT, 2 with a last line on standard error that begins with "tessera-import: ", 3 out of
/// memory.

#include "core/error.hpp"
#include "preprocess/geometry/domain_stream.hpp"
#include "preprocess/geometry/importer/gmsh_model.hpp"
#include "preprocess/geometry/importer/request.hpp"

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
  switch (request.format) {
  case preprocess::CadFormat::msh:
    return importer::import_mesh(request);
  case preprocess::CadFormat::stl:
    return importer::import_stl(request);
  default:
    return importer::import_cad(request);
  }
}

/// Lengths in metres from here on. A group for each named surface where the file has no groups of its own.
void finish(preprocess::Domain& domain, double metres) {
  for (Vec3& X : domain.vertices)
    X *= metres;
  domain.cad_volume *= metres * metres * metres;
  domain.measure();
  if (!domain.groups.empty())
    return;
  for (std::size_t s = 0; s < domain.surfaces.size(); ++s) {
    const auto same = [&](const auto& group) { return group.name == domain.surfaces[s]; };
    auto group = std::find_if(domain.groups.begin(), domain.groups.end(), same);
    if (group == domain.groups.end())
      group = domain.groups.insert(group, {domain.surfaces[s], 2, {}, {}, {}});
    group->surfaces.push_back(static_cast<std::int32_t>(s));
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
  if (argc != 8)
    return fail(2, "FILE NAME UNIT STEP_UNIT TOLERANCE MESH_SIZE OUTPUT are needed");
  try {
    const double metres = std::strtod(argv[3], nullptr);
    const importer::Request request{argv[1],
                                    argv[2],
                                    preprocess::check_cad_file(argv[1]),
                                    argv[4],
                                    std::strtod(argv[5], nullptr),
                                    std::strtod(argv[6], nullptr) / metres};
    preprocess::Domain domain;
    {
      const importer::Gmsh gmsh;
      domain = import(request);
    }
    finish(domain, metres);
    domain.validate(request.name);
    const std::string bytes = preprocess::to_bytes(domain);
    std::ofstream out(argv[7], std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    return out ? 0 : fail(4, "the result cannot be written");
  } catch (const std::bad_alloc&) {
    return fail(3, "out of memory");
  } catch (const std::exception& error) {
    return fail(2, error.what());
  } catch (const std::string& error) {
    return fail(2, std::string(argv[2]) + ": " + error);
  } catch (const char* error) {
    return fail(2, std::string(argv[2]) + ": " + error);
  } catch (int error) {
    return fail(2, std::string(argv[2]) + ": gmsh gave up with code " + std::to_string(error));
  }
}

#include "preprocess/geometry/import.hpp"

#include "core/child_process.hpp"
#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "preprocess/geometry/cad_file.hpp"
#include "preprocess/geometry/domain_stream.hpp"
#include "preprocess/geometry/geo_script.hpp"
#include "preprocess/geometry/iges_file.hpp"
#include "preprocess/geometry/importer/note.hpp"
#include "preprocess/geometry/importer/request.hpp"
#include "preprocess/geometry/shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include <unistd.h>

namespace tessera::preprocess {
namespace {

namespace fs = std::filesystem;

/// Last line of the importer's output that says something, for people to read.
std::string last_words(const std::string& output) {
  std::string last;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    std::string clean; // without OpenCASCADE's colours
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (line[i] == '\x1b')
        i = std::min(line.find('m', i), line.size());
      else if (static_cast<unsigned char>(line[i]) >= 0x20)
        clean += line[i];
    }
    const auto says = clean.find_first_not_of(" *-=");
    if (says != std::string::npos)
      last = clean.substr(clean.find_first_not_of(' '));
  }
  constexpr std::size_t longest = 300;
  if (last.size() > longest)
    last = last.substr(0, longest) + "...";
  return last;
}

std::string quoted_last_words(const std::string& output) {
  const std::string words = last_words(output);
  return words.empty() ? std::string{} : fmt::format(" (it last said \"{}\")", words);
}

bool speaks_of_memory(const std::string& output) {
  for (const char* words : {"bad_alloc", "out of memory", "Out of memory", "OUT OF MEMORY", "Cannot allocate",
                            "could not allocate", "Could not allocate", "memory exhausted",
                            "Not enough memory", "failed to map segment"})
    if (output.find(words) != std::string::npos)
      return true;
  return false;
}

/// What messages call the source.
std::string name_of(const GeometrySource& source) {
  return source.shape ? fmt::format("shape \"{}\"", source.shape->name) : source.file.string();
}

/// Throws what the end of the importer means to a user, unless it ended well.
void check_end(const ChildEnd& end, const GeometrySource& source, const fs::path& program) {
  const std::string name = name_of(source);
  const auto mebibytes = source.bytes >> 20;
  const auto out_of_memory = [&] {
    return InputError(fmt::format("the import needs more than its memory limit of {} MiB", mebibytes), name,
                      "raise [geometry] memory_limit, loosen tolerance or simplify the part");
  };
  switch (end.how) {
  case ChildEnd::How::not_started:
    throw RunError(fmt::format("the importer cannot be started: {}", std::strerror(end.code)),
                   program.string(),
                   "reinstall, or set TESSERA_LIBEXEC to the folder that holds tessera-import");
  case ChildEnd::How::interrupted:
    throw RunError("interrupted during import", name, "run the same command again to start it anew");
  case ChildEnd::How::out_of_time:
    throw InputError(
        fmt::format("the import takes longer than its limit of {:g} s{}", source.seconds,
                    quoted_last_words(end.output)),
        name, "raise [geometry] time_limit, loosen tolerance, enlarge mesh sizes or simplify the part");
  case ChildEnd::How::signalled:
    if (speaks_of_memory(end.output) || end.peak_bytes > source.bytes / 4 * 3)
      throw out_of_memory();
    throw InputError(fmt::format("the CAD kernel crashed on this file: {}{}", ::strsignal(end.code),
                                 quoted_last_words(end.output)),
                     name, "heal the part in a CAD program and export it again");
  case ChildEnd::How::exited:
    break;
  }
  if (end.code == 0)
    return;
  if (end.code == 3 || speaks_of_memory(end.output))
    throw out_of_memory();
  if (end.code == 4)
    throw RunError("the importer cannot write its result", fs::temp_directory_path().string(),
                   "free space there, or set TMPDIR to a folder with room");
  constexpr std::string_view prefix = "tessera-import: ";
  if (const std::string words = last_words(end.output); words.starts_with(prefix))
    throw InputError(words.substr(prefix.size()), "", "");
  throw InputError(
      fmt::format("the importer failed with status {}{}", end.code, quoted_last_words(end.output)), name,
      "heal the part in a CAD program and export it again");
}

/// The unit the numbers of a file are in once gmsh has read it. STEP comes in its own, so that the kernel's
/// absolute tolerances see the part at the size it was drawn (in the case's where the file declares none we
/// know); IGES always in mm (gmsh 4.8 cannot have it otherwise); all others are plain numbers.
std::string unit_as_read(const GeometrySource& source, CadFormat format, Progress& progress) {
  if (format != CadFormat::step && format != CadFormat::iges)
    return source.unit;
  const std::string text = read_text(source.file);
  const bool step = format == CadFormat::step;
  const std::string declared = step ? step_length_unit(text) : iges_length_unit(text);
  if (!declared.empty() && declared != source.unit)
    progress.note(fmt::format("{} is written in {}, not in {}: {} files carry their own unit, and it counts",
                              source.file.filename().string(), declared, source.unit,
                              step ? "STEP" : "IGES"));
  if (!step)
    return "mm";
  return declared.empty() || declared == "ft" ? source.unit : declared;
}

std::string occ_name(const std::string& unit) {
  static const std::map<std::string, std::string> names{
      {"m", "M"}, {"cm", "CM"}, {"mm", "MM"}, {"um", "UM"}, {"in", "INCH"}};
  return names.at(unit);
}

/// Refuses a .geo file that may do more than draw, or whose end gmsh would not see.
void check_script(const GeometrySource& source) {
  const std::string text = read_text(source.file), name = source.file.string();
  if (source.trust) {
    require(text.back() == '\n',
            "the .geo file does not end with a line break: gmsh would skip its last line", name, "add one");
    return;
  }
  const auto finding = forbidden_in_geo(text);
  require(finding.what.empty(),
          fmt::format("the .geo file is refused: it holds {}, which may run programs or touch files",
                      finding.what),
          fmt::format("{}:{}", name, finding.line), "remove it, or set trust = true if you trust the file");
}

/// gmsh also obeys a file of the same name with .opt behind it; under a private name there is none. A trusted
/// .geo is opened where it lies, for it may include its neighbours; another one is copied, with the line
/// break gmsh needs.
fs::path file_to_open(const GeometrySource& source, CadFormat format, const fs::path& folder) {
  const fs::path original = fs::absolute(source.file);
  if (format == CadFormat::geo && source.trust)
    return original;
  std::string extension = source.file.extension().string();
  for (char& c : extension)
    c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const fs::path opened = folder / ("input" + extension);
  if (format == CadFormat::geo)
    std::ofstream(opened, std::ios::binary) << read_text(original) << '\n';
  else
    fs::create_symlink(original, opened);
  return opened;
}

void note_domain(const Domain& domain, const GeometrySource& source, Progress& progress) {
  const std::string unit = source.shape ? "m" : source.unit;
  const double metres = metres_per_unit(unit);
  const Vec3 low = domain.lower / metres, high = domain.upper / metres;
  const std::string name = source.shape ? name_of(source) : source.file.filename().string();
  const bool plane = domain.dimension == 2;
  if (plane)
    progress.note(fmt::format("{}: ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) {}", name, low[0], low[1], high[0],
                              high[1], unit));
  else
    progress.note(fmt::format("{}: ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) {}", name, low[0],
                              low[1], low[2], high[0], high[1], high[2], unit));
  const char* of = plane ? "m^2" : "m^3";
  progress.note(
      fmt::format("{} {:.9g} {} in {} {}, {:.9g} {} by the CAD ({:+.2g} relative); {} {}, {} corners",
                  plane ? "area" : "volume", domain.volume, of,
                  plane ? domain.tets.size() / 3 : domain.tets.size(), plane ? "triangles" : "tetrahedra",
                  domain.cad_volume, of, (domain.volume - domain.cad_volume) / domain.cad_volume,
                  domain.surfaces.size(), plane ? "curves" : "surfaces", domain.corners.size()));
}

/// A shape in a unit that makes its largest length about sixteen: OpenCASCADE's tolerances are absolute. A
/// power of two, so that nothing is rounded.
importer::Request shape_request(const GeometrySource& source) {
  check_shape(*source.shape, source.dimension);
  require(!source.background_sizes, "there are no mesh sizes in a built-in shape", name_of(source),
          "draw it in a .geo file with a Background Field");
  importer::Request request;
  request.shape = source.shape;
  double largest = 0;
  for (const auto& length : source.shape->lengths)
    largest = std::max(largest, *std::max_element(length.begin(), length.end()));
  request.metres = std::exp2(std::floor(std::log2(largest)) - 4);
  for (auto& length : request.shape->lengths)
    for (double& x : length)
      x /= request.metres;
  return request;
}

/// A file, checked from outside; what gmsh is to open lies in `folder`.
importer::Request file_request(const GeometrySource& source, const fs::path& folder, Progress& progress) {
  metres_per_unit(source.unit);
  const CadFormat format = check_cad_file(source.file);
  if (format == CadFormat::geo)
    check_script(source);
  require(source.dimension == 3 || !is_triangle_surface(format),
          "a file of bare surface triangles holds no plane figure", source.file.string(),
          "give a .geo, .step, .iges, .brep or .msh file, or set [geometry] dimension = 3");
  require(!source.background_sizes || format == CadFormat::geo || format == CadFormat::msh,
          "there are no mesh sizes in files of this kind", source.file.string(),
          "give a .geo file with a Background Field or sizes at its points, or a .msh file");
  importer::Request request;
  const std::string unit = unit_as_read(source, format, progress);
  if (format == CadFormat::step)
    request.cad_unit = occ_name(unit);
  request.metres = metres_per_unit(unit);
  request.file = file_to_open(source, format, folder).string();
  return request;
}

} // namespace

double metres_per_unit(const std::string& unit) {
  static const std::map<std::string, double> units{
      {"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"in", 0.0254}};
  const auto it = units.find(unit);
  if (it == units.end())
    throw InputError(unit.empty() ? "the geometry has no unit" : fmt::format("unknown unit \"{}\"", unit),
                     "[geometry] unit", "give \"m\", \"cm\", \"mm\", \"um\" or \"in\"");
  return it->second;
}

Domain import_geometry(const GeometrySource& source, Progress& progress) {
  const std::string name = name_of(source);
  require(std::isfinite(source.tolerance) && source.tolerance > 0, "the tolerance is not a positive number",
          "[geometry] tolerance", "give a relative error of the volume such as 1e-3");
  require(std::isfinite(source.mesh_size) && source.mesh_size >= 0,
          "the mesh size is negative or not a number", "[geometry] mesh_size",
          "give a length in metres, or 0 for a tenth of the part");
  require(source.dimension == 2 || source.dimension == 3,
          fmt::format("there are no bodies of dimension {}", source.dimension), "[geometry] dimension",
          "give 2 for a plane body, or 3");
  require(source.solid >= 0, fmt::format("solid is {}", source.solid), "[geometry] solid",
          "count from 1, or give 0 where there is only one");

  require(source.close_holes >= 0, fmt::format("close_holes is {}", source.close_holes),
          "[geometry] close_holes", "give the largest number of edges of a hole to close, or 0 for none");

  const TemporaryFolder folder;
  importer::Request request =
      source.shape ? shape_request(source) : file_request(source, folder.path(), progress);
  const fs::path result = folder.path() / "domain";
  request.name = name;
  request.output = result.string();
  request.tolerance = source.tolerance;
  request.mesh_size = source.mesh_size / request.metres;
  request.dimension = source.dimension;
  request.solid = source.solid;
  request.close_holes = source.close_holes;
  request.background_sizes = source.background_sizes;

  const fs::path program = companion_program("tessera-import");
  std::vector<std::string> command = importer::to_arguments(request);
  command.insert(command.begin(), program.string());
  const ChildEnd end = run_child(command, folder.path(), {source.seconds, source.bytes});
  check_end(end, source, program);

  Domain domain;
  try {
    domain = from_bytes(fs::exists(result) ? read_text(result) : std::string{});
  } catch (const std::runtime_error& error) {
    throw InputError(
        fmt::format("the importer gave no usable answer: {}{}", error.what(), quoted_last_words(end.output)),
        name, "try again; if it stays, heal the part in a CAD program");
  }
  domain.validate(name);
  std::istringstream lines(end.output);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(importer::note_prefix))
      progress.note(line.substr(importer::note_prefix.size()));
  note_domain(domain, source, progress);
  return domain;
}

} // namespace tessera::preprocess

#include "preprocess/geometry/cad_file.hpp"

#include "core/error.hpp"
#include "preprocess/geometry/iges_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

namespace tessera::preprocess {
namespace {

const std::map<std::string, CadFormat> formats{
    {".step", CadFormat::step}, {".stp", CadFormat::step},  {".iges", CadFormat::iges},
    {".igs", CadFormat::iges},  {".brep", CadFormat::brep}, {".geo", CadFormat::geo},
    {".msh", CadFormat::msh},   {".stl", CadFormat::stl},   {".obj", CadFormat::obj},
    {".ply", CadFormat::ply},
};
constexpr const char* accepted =
    "give one of .step, .stp, .iges, .igs, .brep, .geo, .msh (4.1 or 2.2), .stl, .obj, .ply";

std::string read_part(const std::filesystem::path& file, std::streamoff from, std::size_t length) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(from, from < 0 ? std::ios::end : std::ios::beg);
  if (!in) {
    in.clear();
    in.seekg(0);
  }
  std::string text(length, '\0');
  in.read(text.data(), static_cast<std::streamsize>(length));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

/// One instance of the data section of a STEP file, `#number = body;`, without comments and white space (but
/// with its strings as they are).
struct StepInstance {
  std::size_t number;
  std::string body;
};

std::vector<StepInstance> step_instances(std::string_view text) {
  std::vector<StepInstance> instances;
  std::string statement;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c != '\n' && c != '\r')
        statement += c;
      in_string = c != '\'';
      continue;
    }
    if (c == '/' && i + 1 < text.size() && text[i + 1] == '*') {
      const std::size_t end = text.find("*/", i + 2);
      if (end == std::string_view::npos)
        break;
      i = end + 1;
    } else if (c == ';') {
      std::size_t number = 0;
      if (statement.size() > 1 && statement[0] == '#') {
        const auto [rest, error] =
            std::from_chars(statement.data() + 1, statement.data() + statement.size(), number);
        if (error == std::errc{} && *rest == '=')
          instances.push_back({number, std::string(rest + 1)});
      }
      statement.clear();
    } else if (!std::isspace(static_cast<unsigned char>(c))) {
      in_string = c == '\'';
      statement += c;
    }
  }
  return instances;
}

/// The text between the first pair of quotes of an instance.
std::string quoted(const std::string& body) {
  const auto first = body.find('\'');
  const auto last = first == std::string::npos ? first : body.find('\'', first + 1);
  return last == std::string::npos ? std::string{} : body.substr(first + 1, last - first - 1);
}

/// Numbers of the instances that the text names, in order.
std::vector<std::size_t> references(std::string_view text) {
  std::vector<std::size_t> numbers;
  for (std::size_t i = text.find('#'); i != std::string_view::npos; i = text.find('#', i + 1)) {
    std::size_t number = 0;
    if (std::from_chars(text.data() + i + 1, text.data() + text.size(), number).ec == std::errc{})
      numbers.push_back(number);
  }
  return numbers;
}

/// Unit of one LENGTH_UNIT instance; empty when it is not one of ours.
std::string unit_of(const std::string& body) {
  if (body.find("CONVERSION_BASED_UNIT(") != std::string::npos) {
    std::string name = quoted(body);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::toupper(c); });
    if (name == "INCH")
      return "in";
    if (name == "FOOT")
      return "ft";
    return {};
  }
  static const std::map<std::string, std::string> si{
      {"$", "m"}, {".CENTI.", "cm"}, {".MILLI.", "mm"}, {".MICRO.", "um"}};
  const auto open = body.find("SI_UNIT(");
  if (open == std::string::npos)
    return {};
  const auto comma = body.find(',', open);
  if (comma == std::string::npos || body.compare(comma + 1, 8, ".METRE.)") != 0)
    return {};
  const auto it = si.find(body.substr(open + 8, comma - open - 8));
  return it == si.end() ? std::string{} : it->second;
}

} // namespace

std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || in.bad())
    throw InputError("the file cannot be read", file.string(), "check its permissions");
  return std::move(text).str();
}

CadFormat check_cad_file(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  require(std::filesystem::exists(status), "no such geometry file", name,
          "check the path in [geometry] file");
  require(!std::filesystem::is_directory(status), "the geometry is a folder, not a file", name, accepted);
  require(std::filesystem::is_regular_file(status), "the geometry is not a plain file", name, accepted);

  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const auto found = formats.find(extension);
  require(found != formats.end(),
          extension.empty() ? "the geometry file has no extension"
                            : fmt::format("geometry files of type \"{}\" are not read", extension),
          name, accepted);
  const auto bytes = std::filesystem::file_size(file, error);
  require(!error && bytes > 0, "the geometry file is empty", name, "export it again");
  require(std::ifstream(file).good(), "the geometry file cannot be opened", name, "check its permissions");

  const auto not_what_it_says = [&](const char* kind) {
    return InputError(fmt::format("the file is not {} although it is called {}", kind, extension), name,
                      "export it again, or give it the extension of what it is");
  };
  const std::string head = read_part(file, 0, 4096);
  switch (found->second) {
  case CadFormat::step: {
    const auto start = head.find_first_not_of(" \t\r\n");
    if (start == std::string::npos || head.compare(start, 12, "ISO-10303-21") != 0)
      throw not_what_it_says("a STEP file");
    require(read_part(file, -4096, 4096).find("END-ISO-10303-21") != std::string::npos,
            "the STEP file is cut off: its closing line END-ISO-10303-21 is missing", name,
            "export or copy it again");
    break;
  }
  case CadFormat::brep:
    if (head.find("DBRep_DrawableShape") == std::string::npos &&
        head.find("CASCADE Topology") == std::string::npos)
      throw not_what_it_says("an OpenCASCADE BREP file");
    break;
  case CadFormat::msh: {
    if (head.rfind("$MeshFormat", 0) != 0)
      throw not_what_it_says("a gmsh mesh");
    std::istringstream line(head.substr(11));
    double version = 0;
    line >> version;
    require(version == 4.1 || version == 2.2, fmt::format("gmsh meshes of version {} are not read", version),
            name, "save it as version 4.1 or 2.2");
    break;
  }
  case CadFormat::iges:
    check_iges(read_text(file), name);
    break;
  case CadFormat::geo:
  case CadFormat::stl:
  case CadFormat::obj:
  case CadFormat::ply:
    break; // any text is a program to gmsh; the readers of triangle surfaces find out themselves
  }
  return found->second;
}

std::string step_length_unit(std::string_view text) {
  const auto instances = step_instances(text);
  std::map<std::size_t, const std::string*> lengths;
  std::vector<std::size_t> assigned;
  for (const auto& [number, body] : instances) {
    if (body.find("LENGTH_UNIT()") != std::string::npos)
      lengths[number] = &body;
    const auto context = body.find("GLOBAL_UNIT_ASSIGNED_CONTEXT(");
    if (context == std::string::npos)
      continue;
    const auto end = body.find(')', context);
    for (const std::size_t unit : references(std::string_view(body).substr(context, end - context)))
      assigned.push_back(unit);
  }
  std::optional<std::string> unit;
  for (const std::size_t number : assigned) {
    const auto it = lengths.find(number);
    if (it == lengths.end())
      continue;
    const std::string name = unit_of(*it->second);
    if (unit && *unit != name)
      return {};
    unit = name;
  }
  return unit.value_or("");
}

std::vector<std::string> step_face_names(std::string_view text) {
  std::map<std::size_t, std::string> faces;
  std::vector<std::vector<std::size_t>> shells;
  for (const auto& [number, body] : step_instances(text)) {
    if (body.rfind("ADVANCED_FACE(", 0) == 0)
      faces[number] = quoted(body);
    if (body.rfind("CLOSED_SHELL(", 0) == 0)
      shells.push_back(references(body));
  }
  if (shells.size() != 1)
    return {};
  std::vector<std::string> names;
  for (const std::size_t number : shells[0]) {
    const auto it = faces.find(number);
    names.push_back(it == faces.end() || it->second == "NONE" ? std::string{} : it->second);
  }
  return names;
}

} // namespace tessera::preprocess

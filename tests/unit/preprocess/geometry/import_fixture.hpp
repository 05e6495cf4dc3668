/// What all tests of the import share: a folder for a moment's files, and the import as the program does it.
#pragma once

#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "preprocess/geometry/import.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

namespace tessera::preprocess {

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << "it says: " << (text)

inline std::string slurp(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

class ImportFixture : public testing::Test {
 protected:
  ~ImportFixture() override { ::unsetenv("TESSERA_LIBEXEC"); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder() / name, std::ios::binary) << text;
    return folder() / name;
  }
  /// A .geo file for OpenCASCADE.
  std::filesystem::path occ(const std::string& name, const std::string& text) const {
    return write(name, "SetFactory(\"OpenCASCADE\");\n" + text);
  }
  /// A program in the importer's place.
  void stand_in(const std::string& script) const {
    const std::filesystem::path program = write("tessera-import", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    ::setenv("TESSERA_LIBEXEC", folder().c_str(), 1);
  }

  static Domain import(const GeometrySource& source) { return import_geometry(source, Progress::silent()); }
  static Domain import(const std::filesystem::path& file, const std::string& unit = "mm",
                       double tolerance = 1e-3) {
    GeometrySource source;
    source.file = file;
    source.unit = unit;
    source.tolerance = tolerance;
    return import(source);
  }
  static Domain import_plane(const std::filesystem::path& file, const std::string& unit = "m",
                             double tolerance = 1e-3) {
    GeometrySource source;
    source.file = file;
    source.unit = unit;
    source.tolerance = tolerance;
    source.dimension = 2;
    return import(source);
  }
  static GeometrySource shape(const std::string& name, std::vector<std::vector<double>> lengths,
                              int dimension = 3) {
    GeometrySource source;
    source.shape = ShapeSpec{name, std::move(lengths)};
    source.dimension = dimension;
    return source;
  }

  /// What the import complains of; empty when it does not. Every complaint is one line and names its source.
  static std::string complaint(const GeometrySource& source) {
    try {
      import(source);
    } catch (const InputError& error) {
      const std::string said = error.what();
      EXPECT_SAYS(said, source.shape ? "" : source.file.filename().string());
      EXPECT_EQ(said.find('\n'), std::string::npos) << said;
      return said;
    }
    return {};
  }
  static std::string complaint(const std::filesystem::path& file, int dimension = 3) {
    GeometrySource source;
    source.file = file;
    source.unit = "mm";
    source.dimension = dimension;
    return complaint(source);
  }

  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
};

inline std::size_t curves(const Domain& domain) {
  std::set<std::int32_t> found;
  for (const auto& edge : domain.feature_edges)
    found.insert(edge.curve);
  EXPECT_FALSE(found.contains(-1));
  return found.size();
}

/// Area (length, of a plane body) of each group of surfaces.
inline std::map<std::string, double> areas(const Domain& domain) {
  std::map<std::string, double> found;
  for (const auto& group : domain.groups)
    for (const auto& facet : domain.facets)
      if (std::count(group.surfaces.begin(), group.surfaces.end(), facet.surface) > 0) {
        const Vec3& A = domain.vertices[facet.vertices[0]];
        found[group.name] +=
            (domain.vertices[facet.vertices[1]] - A).cross(domain.vertices[facet.vertices[2]] - A).norm() / 2;
      }
  return found;
}

inline const Domain::Group& group_named(const Domain& domain, const std::string& name) {
  const auto it = std::find_if(domain.groups.begin(), domain.groups.end(),
                               [&](const auto& group) { return group.name == name; });
  if (it == domain.groups.end())
    throw std::out_of_range("no group " + name);
  return *it;
}

} // namespace tessera::preprocess

/// Domains as mesh files.
#pragma once

#include "preprocess/geometry/domain.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>

namespace tessera::test {

using preprocess::Domain;

/// Boundary of a domain as STL.
inline std::string text_stl(const Domain& domain) {
  std::string text = "solid part\n";
  for (const auto& facet : domain.facets) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const auto v : facet.vertices)
      text += fmt::format("   vertex {:.9e} {:.9e} {:.9e}\n", domain.vertices[v][0], domain.vertices[v][1],
                          domain.vertices[v][2]);
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid part\n";
}

inline std::string binary_stl(const Domain& domain) {
  std::string bytes = "solid as some binary files begin";
  bytes.resize(80, ' ');
  const auto count = static_cast<std::uint32_t>(domain.facets.size());
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& facet : domain.facets) {
    bytes.append(12, '\0');
    for (const auto v : facet.vertices)
      for (int c = 0; c < 3; ++c) {
        const auto x = static_cast<float>(domain.vertices[v][c]);
        bytes.append(reinterpret_cast<const char*>(&x), 4);
      }
    bytes.append(2, '\0');
  }
  return bytes;
}

/// Tetrahedra as a gmsh mesh of version 2.2; the boundary triangles, too, when asked for.
inline std::string msh2(const Domain& domain, bool triangles) {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  if (triangles) {
    text += fmt::format("$PhysicalNames\n{}\n", domain.surfaces.size());
    for (std::size_t s = 0; s < domain.surfaces.size(); ++s)
      text += fmt::format("2 {} \"{}\"\n", s + 1, domain.surfaces[s]);
    text += "$EndPhysicalNames\n";
  }
  text += fmt::format("$Nodes\n{}\n", domain.vertices.size());
  for (std::size_t v = 0; v < domain.vertices.size(); ++v)
    text += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", v + 1, domain.vertices[v][0], domain.vertices[v][1],
                        domain.vertices[v][2]);
  text +=
      fmt::format("$EndNodes\n$Elements\n{}\n", domain.tets.size() + (triangles ? domain.facets.size() : 0));
  std::size_t n = 0;
  if (triangles)
    for (const auto& f : domain.facets)
      text += fmt::format("{} 2 2 {} {} {} {} {}\n", ++n, f.surface + 1, f.surface + 1, f.vertices[0] + 1,
                          f.vertices[1] + 1, f.vertices[2] + 1);
  for (const auto& t : domain.tets)
    text += fmt::format("{} 4 2 1 1 {} {} {} {}\n", ++n, t[0] + 1, t[1] + 1, t[2] + 1, t[3] + 1);
  return text + "$EndElements\n";
}

/// Boundary as a Wavefront OBJ file. `quads`: pairs of triangles that share a diagonal and a plane become one
/// polygon.
inline std::string obj(const Domain& domain, bool quads = false) {
  std::string text = "# a part\no part\n";
  for (const Vec3& X : domain.vertices)
    text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", X[0], X[1], X[2]);
  std::vector<char> done(domain.facets.size(), 0);
  for (std::size_t f = 0; f < domain.facets.size(); ++f) {
    if (done[f])
      continue;
    std::vector<std::int32_t> polygon(domain.facets[f].vertices.begin(), domain.facets[f].vertices.end());
    for (std::size_t g = f + 1; quads && g < domain.facets.size() && polygon.size() == 3; ++g) {
      if (done[g] || domain.facets[g].surface != domain.facets[f].surface)
        continue;
      const auto& other = domain.facets[g].vertices;
      for (int e = 0; e < 3 && polygon.size() == 3; ++e)
        for (int k = 0; k < 3; ++k)
          if (polygon[e] == other[(k + 1) % 3] && polygon[(e + 1) % 3] == other[k]) {
            polygon.insert(polygon.begin() + e + 1, other[(k + 2) % 3]);
            done[g] = 1;
            break;
          }
    }
    text += "f";
    for (const auto v : polygon)
      text += fmt::format(" {}//1", v + 1);
    text += "\n";
  }
  return text;
}

/// Boundary as a Stanford PLY file.
inline std::string ply(const Domain& domain, bool binary) {
  std::string bytes =
      fmt::format("ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
                  "property double z\nelement face {}\nproperty list uchar int vertex_indices\n"
                  "end_header\n",
                  binary ? "binary_little_endian" : "ascii", domain.vertices.size(), domain.facets.size());
  const auto append = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const Vec3& X : domain.vertices) {
    if (!binary)
      bytes += fmt::format("{:.17g} {:.17g} {:.17g}\n", X[0], X[1], X[2]);
    for (int c = 0; binary && c < 3; ++c)
      append(X[c]);
  }
  for (const auto& facet : domain.facets) {
    if (!binary)
      bytes += fmt::format("3 {} {} {}\n", facet.vertices[0], facet.vertices[1], facet.vertices[2]);
    else
      append(std::uint8_t{3});
    for (int v = 0; binary && v < 3; ++v)
      append(facet.vertices[v]);
  }
  return bytes;
}

} // namespace tessera::test

#include "core/error.hpp"
#include "io/body_file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace tessera::io {
namespace {

TEST(BodyFile, RoundTrip) {
  const test::TemporaryFolder folder;
  BodyMesh mesh;
  mesh.points = {{0, 0, 0}, {1.0 / 3, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.solids = {{0, 1, 2, 3}};
  mesh.faces = {{0, 2, 1}, {1, 2, 3}};
  mesh.edges = {{0, 3}};
  write_body(mesh, folder / "body.vtu");
  const BodyMesh read = read_body(folder / "body.vtu");
  EXPECT_EQ(read.dimension, 3);
  EXPECT_EQ(read.points, mesh.points);
  EXPECT_EQ(read.solids, mesh.solids);
  EXPECT_EQ(read.faces, mesh.faces);
  EXPECT_EQ(read.edges, mesh.edges);
}

TEST(BodyFile, APlaneBodyAndDamage) {
  const test::TemporaryFolder folder;
  write_body({2, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {{0, 1, 2}}, {{0, 1}}}, folder / "body.vtu");
  EXPECT_EQ(read_body(folder / "body.vtu").dimension, 2);
  const std::string bytes = test::content(folder / "body.vtu");
  test::store(folder / "cut.vtu", bytes.substr(0, bytes.size() / 2));
  EXPECT_THROW(read_body(folder / "cut.vtu"), InputError);
  EXPECT_THROW(read_body(folder / "none.vtu"), InputError);
}

} // namespace
} // namespace tessera::io

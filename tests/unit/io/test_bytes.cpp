#include "core/error.hpp"
#include "io/bytes.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace tessera::io {
namespace {

TEST(Bytes, AreReadAsTheyAre) {
  const test::TemporaryFolder folder;
  const std::string content("a\0b\r\n\xff", 6);
  std::ofstream(folder / "file", std::ios::binary) << content;
  std::ofstream(folder / "empty");
  EXPECT_EQ(read_bytes(folder / "file"), content);
  EXPECT_EQ(read_bytes(folder / "empty"), "");
  EXPECT_THROW(read_bytes(folder / "none"), RunError);
}

// FIPS 180-4's examples.
TEST(Bytes, Sha256) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

} // namespace
} // namespace tessera::io

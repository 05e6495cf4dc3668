#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

namespace tessera::io {
namespace {

using test::content;
using test::TemporaryFolder;

int files_in(const std::filesystem::path& folder) {
  int count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder))
    ++count;
  return count;
}

TEST(AtomicFile, TextArrivesWholeAndReplacesTheEarlier) {
  const TemporaryFolder folder;
  write_text(folder / "a.json", "first, and longer");
  write_text(folder / "a.json", std::string("second\0", 7));
  EXPECT_EQ(content(folder / "a.json"), std::string("second\0", 7));
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(AtomicFile, TheWriterSeesATemporaryWithTheSameExtensionInTheSameFolder) {
  const TemporaryFolder folder;
  std::filesystem::path seen;
  write_atomically(folder / "picture.png", [&](const std::filesystem::path& temporary) {
    seen = temporary;
    test::store(temporary, "x");
    EXPECT_FALSE(std::filesystem::exists(folder / "picture.png"));
  });
  EXPECT_EQ(seen.extension(), ".png");
  EXPECT_EQ(seen.parent_path(), folder.path());
  EXPECT_EQ(content(folder / "picture.png"), "x");
}

TEST(AtomicFile, AFailingWriterLeavesTheEarlierFileAndNoTemporary) {
  const TemporaryFolder folder;
  write_text(folder / "a.txt", "earlier");
  const auto fails = [](const std::filesystem::path& temporary) {
    test::store(temporary, "half");
    throw std::runtime_error("broken");
  };
  EXPECT_THROW(write_atomically(folder / "a.txt", fails), std::runtime_error);
  const auto nothing = [](const std::filesystem::path& temporary) { test::store(temporary, ""); };
  EXPECT_THROW(write_atomically(folder / "a.txt", nothing), RunError);
  EXPECT_THROW(write_atomically(folder / "a.txt", [](const auto&) {}), RunError);
  EXPECT_EQ(content(folder / "a.txt"), "earlier");
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(AtomicFile, AFullDiskIsNamedAndLeavesTheEarlierFile) {
  const TemporaryFolder folder;
  write_text(folder / "a.txt", "earlier");
  const std::string message =
      test::message_with_file_limit(1000, [&] { write_text(folder / "a.txt", std::string(5000, 'x')); });
  EXPECT_NE(message.find("File too large"), std::string::npos) << message;
  EXPECT_NE(message.find((folder / "a.txt").string()), std::string::npos) << message;
  EXPECT_EQ(content(folder / "a.txt"), "earlier");
  EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(AtomicFile, AMissingFolderIsNamedWithTheSystemsReason) {
  const TemporaryFolder folder;
  try {
    write_text(folder / "nowhere/a.txt", "x");
    FAIL();
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("nowhere/a.txt"), std::string::npos) << error.what();
  }
}

TEST(AtomicFile, OutputFoldersAreMadeAndProven) {
  const TemporaryFolder folder;
  make_output_folder(folder / "a/b/c");
  EXPECT_TRUE(std::filesystem::is_empty(folder / "a/b/c"));
  make_output_folder(folder / "a/b/c");
  test::store(folder / "file", "x");
  EXPECT_THROW(make_output_folder(folder / "file"), InputError);
  EXPECT_THROW(make_output_folder(folder / "file/below"), InputError);
  EXPECT_THROW(make_output_folder("/proc/self/nothing"), InputError);
}

} // namespace
} // namespace tessera::io

#include "core/child_process.hpp"

#include "core/temporary_folder.hpp"
#include "tests/support/processes.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <string>

using namespace tessera;
using How = ChildEnd::How;

TEST(ChildProcess, OutputStatusAndFolderComeBack) {
  const TemporaryFolder folder;
  const ChildEnd end =
      run_child({"/bin/sh", "-c", "echo out; echo err >&2; echo $TMPDIR; pwd; exit 7"}, folder.path(), {10});
  EXPECT_EQ(end.how, How::exited);
  EXPECT_EQ(end.code, 7);
  const std::string here = folder.path().string() + "\n";
  EXPECT_EQ(end.output, "out\nerr\n" + here + here);
}

TEST(ChildProcess, ASlowOneIsEndedWithItsChildren) {
  const TemporaryFolder folder;
  for (const double grace : {0.0, 1.0}) {
    const auto start = std::chrono::steady_clock::now();
    const ChildEnd end =
        run_child({"/bin/sh", "-c", "sleep 60 & echo $!; wait"}, folder.path(), {0.3, 0, grace});
    EXPECT_EQ(end.how, How::out_of_time);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
    EXPECT_TRUE(test::ends_within_two_seconds(std::stoi(end.output)));
  }
}

TEST(ChildProcess, OneThatIgnoresTheRequestIsKilled) {
  const TemporaryFolder folder;
  const auto start = std::chrono::steady_clock::now();
  const ChildEnd end =
      run_child({"/bin/sh", "-c", "trap '' TERM; sleep 60 & wait; sleep 60"}, folder.path(), {0.3, 0, 0.3});
  EXPECT_EQ(end.how, How::out_of_time);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST(ChildProcess, ASignalIsReported) {
  const TemporaryFolder folder;
  const ChildEnd end = run_child({"/bin/sh", "-c", "kill -SEGV $$"}, folder.path(), {10});
  EXPECT_EQ(end.how, How::signalled);
  EXPECT_EQ(end.code, 11);
}

TEST(ChildProcess, OneThatDoesNotExistIsNotStarted) {
  const TemporaryFolder folder;
  const ChildEnd end = run_child({"/nowhere/program"}, folder.path(), {10});
  EXPECT_EQ(end.how, How::not_started);
  EXPECT_EQ(end.code, ENOENT);
}

TEST(ChildProcess, ProgramsAreFoundInThePath) {
  EXPECT_TRUE(find_program("tessera-no-such-program").empty());
  EXPECT_FALSE(find_program("sh").empty());
}

TEST(TemporaryFolder, IsGoneWithItsContentsAfterItsScope) {
  std::filesystem::path path;
  {
    const TemporaryFolder folder;
    path = folder.path();
    std::ofstream(path / "file") << "text";
    EXPECT_TRUE(std::filesystem::exists(path / "file"));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

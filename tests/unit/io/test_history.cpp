#include "core/error.hpp"
#include "io/history.hpp"
#include "tests/support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

namespace tessera::io {
namespace {

using test::TemporaryFolder;

TEST(History, RoundTripKeepsEveryBit) {
  const TemporaryFolder folder;
  HistoryFile file(folder / "history.csv");
  file.columns({"time_s", "tip, \"left\"_m"});
  file.row({1.0 / 3, 1e-300});
  file.row({-0.0, std::numeric_limits<double>::infinity()});
  file.row({1, std::nan("")});
  const History history = read_history(folder / "history.csv"); // while it is still open: rows are flushed
  ASSERT_EQ(history.names, (std::vector<std::string>{"time_s", "tip, \"left\"_m"}));
  const auto& time = history.column("time_s");
  ASSERT_EQ(time.size(), 3u);
  EXPECT_EQ(time[0], 1.0 / 3);
  EXPECT_TRUE(std::signbit(time[1]));
  const auto& tip = history.column("tip, \"left\"_m");
  EXPECT_EQ(tip[0], 1e-300);
  EXPECT_TRUE(std::isinf(tip[1]));
  EXPECT_TRUE(std::isnan(tip[2]));
}

TEST(History, CommentsBeforeTheNamesArePassedOver) {
  const TemporaryFolder folder;
  std::ofstream(folder / "reference.csv") << "# measured\n# by hand\ntime_s,radius_m\n0,1\n1,2\n";
  const History history = read_history(folder / "reference.csv");
  EXPECT_EQ(history.names, (std::vector<std::string>{"time_s", "radius_m"}));
  EXPECT_EQ(history.column("radius_m"), (std::vector<double>{1, 2}));
  std::ofstream(folder / "comments.csv") << "# nothing else\n";
  EXPECT_THROW(read_history(folder / "comments.csv"), InputError);
}

TEST(History, AnUnfinishedLastRowIsLeftOut) {
  const TemporaryFolder folder;
  for (const char* part : {"0.2", "0.2,", "0.2,1", "0.2,1.5e", "0.2,1\n0"}) {
    test::store(folder / "h.csv", std::string("time_s,x_m\n0.1,1\n") + part);
    const History history = read_history(folder / "h.csv");
    const std::size_t rows = std::string(part).find('\n') == std::string::npos ? 1 : 2;
    EXPECT_EQ(history.column("x_m").size(), rows) << part;
  }
}

TEST(History, BadFilesAreNamedWithTheLine) {
  const TemporaryFolder folder;
  EXPECT_THROW(read_history(folder / "none.csv"), InputError);
  test::store(folder / "h.csv", "");
  EXPECT_THROW(read_history(folder / "h.csv"), InputError);
  test::store(folder / "h.csv", "time_s,x_m\n0.1,1\n0.2,abc\n0.3,1\n");
  try {
    read_history(folder / "h.csv");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("h.csv:3"), std::string::npos) << error.what();
  }
}

TEST(History, AnUnknownColumnIsAnsweredWithTheNearest) {
  const History history{{"time_s", "radius_m"}, {{0}, {1}}};
  try {
    history.column("radus_m");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("did you mean 'radius_m'"), std::string::npos) << error.what();
  }
}

TEST(History, AFullDiskIsNamed) {
  HistoryFile file("/dev/full");
  try {
    file.columns({"time_s"});
    FAIL();
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("No space left on device"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace tessera::io

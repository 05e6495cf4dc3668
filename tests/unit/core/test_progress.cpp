#include "core/progress.hpp"

#include <gtest/gtest.h>

#include <sstream>

using namespace tessera;

TEST(Progress, PlainLinesAtTenthsWithTimeLeft) {
  std::ostringstream out;
  double now = 0;
  Progress progress(out, false, false, [&] { return now; });
  progress.begin("solve", 100);
  for (int i = 1; i <= 100; ++i) {
    now = 0.6 * i;
    progress.advance(i);
  }
  progress.finish("100 steps");
  EXPECT_EQ(out.str().find('\r'), std::string::npos);
  EXPECT_NE(out.str().find("solve  50 %, 30 s left\n"), std::string::npos);
  EXPECT_NE(out.str().find("solve: done in 1 min 00 s, 100 steps\n"), std::string::npos);
  int lines = 0;
  for (const char c : out.str())
    lines += c == '\n';
  EXPECT_EQ(lines, 11);
}

TEST(Progress, TimeLeftGoesByHowItWentLately) {
  std::ostringstream out;
  double now = 0;
  Progress progress(out, false, false, [&] { return now; });
  progress.begin("solve", 10);
  for (int i = 1; i <= 8; ++i) { // the later half of the work is ten times as slow
    now += i <= 5 ? 1 : 10;
    progress.advance(i);
  }
  EXPECT_NE(out.str().find("solve  80 %, 20 s left\n"), std::string::npos) << out.str();
}

TEST(Progress, ATerminalGetsOneLineRewritten) {
  std::ostringstream out;
  double now = 0;
  Progress progress(out, true, false, [&] { return now; });
  progress.begin("cells", 10);
  now = 1;
  progress.advance(5, "L-part");
  progress.finish();
  EXPECT_EQ(out.str(), "\rcells  50 %, 1.0 s left, L-part\x1b[K\r\x1b[Kcells: done in 1.0 s\n");
}

TEST(Progress, QuietSaysNothing) {
  std::ostringstream out;
  Progress progress(out, false, true);
  progress.note("hello");
  progress.begin("a", 1);
  progress.advance(1);
  progress.finish();
  EXPECT_EQ(out.str(), "");
}

TEST(Duration, ReadsAsPeopleSayIt) {
  EXPECT_EQ(duration(3.21), "3.2 s");
  EXPECT_EQ(duration(59.4), "59 s");
  EXPECT_EQ(duration(250), "4 min 10 s");
  EXPECT_EQ(duration(7500), "2 h 05 min");
}

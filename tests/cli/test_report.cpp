// What people open in their browser: the one-file reports of runs, comparisons and studies.

#include "tests/cli/small_case.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <regex>

namespace tessera::cli {
namespace {

/// "8 of 8 images, 0 requests, overhang 0": how many images a page shows, what it asked the outside for, and
/// by how many pixels it is wider than the window. The page itself has no scripts: a copy of it gets one.
std::string seen_by_a_browser(const Workplace& place, const std::string& page) {
  place.write("seen.html", place.read(page) + R"(<script>addEventListener("load", () => {
    const images = [...document.images];
    const shown = images.filter(image => image.complete && image.naturalWidth > 100).length;
    const requests = performance.getEntriesByType("resource").filter(r => !r.name.startsWith("data:")).length;
    const overhang = document.documentElement.scrollWidth - document.documentElement.clientWidth;
    document.title = `${shown} of ${images.length} images, ${requests} requests, overhang ${overhang}`;
  })</script>)");
  const std::string command =
      fmt::format("chromium --headless --no-sandbox --disable-gpu --user-data-dir={0}/browser "
                  "--virtual-time-budget=10000 "
                  "--window-size=1200,900 --dump-dom file://{0}/seen.html 2>{0}/browser.log",
                  place.path().string());
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string page_text;
  std::array<char, 4096> piece{};
  while (const std::size_t got = std::fread(piece.data(), 1, piece.size(), pipe))
    page_text.append(piece.data(), got);
  EXPECT_EQ(pclose(pipe), 0) << place.read("browser.log");
  std::smatch title;
  std::regex_search(page_text, title, std::regex("<title>([^<]*)</title>"));
  return title.str(1);
}

std::size_t images_in(const std::string& page) {
  std::size_t count = 0;
  for (std::size_t at = page.find("<img "); at != std::string::npos; at = page.find("<img ", at + 1))
    ++count;
  return count;
}

/// All pictures there, no request, nothing that leads outside.
void expect_whole_page(const Workplace& place, const std::string& file, std::size_t at_least) {
  const std::string page = place.read(file);
  const std::size_t images = images_in(page);
  EXPECT_GE(images, at_least) << file;
  EXPECT_EQ(page.find("http:"), std::string::npos) << file;
  EXPECT_EQ(page.find("https:"), std::string::npos) << file;
  EXPECT_EQ(seen_by_a_browser(place, file), fmt::format("{0} of {0} images, 0 requests, overhang 0", images));
}

class Report : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v chromium >/dev/null && command -v xvfb-run >/dev/null") != 0)
      GTEST_SKIP() << "needs chromium and xvfb-run: scripts/setup installs both";
  }
};

TEST_F(Report, OfRunsComparisonsAndStudiesOpenInABrowserWithAllPictures) {
  const Workplace place;
  write_small_case(place);
  const Workplace::Surroundings drawn{true, 0, ""};
  ASSERT_EQ(place.tessera({"run", "case.toml", "--quiet", "-o", "one"}, drawn).status, 0);
  expect_whole_page(place, "one/report.html", 6);
  ASSERT_EQ(place.tessera({"compare", "one", "one", "--quiet", "-o", "both"}, drawn).status, 0);
  expect_whole_page(place, "both/compare.html", 3);
  place.write("study.toml",
              "title = \"sizes\"\ncase = \"case.toml\"\n[error]\nprobe = \"length\"\nvalue = 0.0196\n"
              "[[axis]]\nname = \"law\"\nkey = \"material.law\"\nvalues = [\"hencky\"]\n"
              "[[axis]]\nname = \"size\"\nkey = \"particles.spacing\"\nvalues = [2e-3, 2.5e-3, 3e-3]\n");
  ASSERT_EQ(place.tessera({"study", "study.toml", "--quiet", "-o", "sizes"}, drawn).status, 0);
  expect_whole_page(place, "sizes/report.html", 2);
}

} // namespace
} // namespace tessera::cli

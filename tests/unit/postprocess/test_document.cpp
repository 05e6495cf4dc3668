#include "core/error.hpp"
#include "postprocess/document.hpp"
#include "tests/unit/postprocess/stored_run.hpp"

#include <gtest/gtest.h>

namespace tessera::post {
namespace {

using test::TemporaryFolder;

const Document sample{"Bar & <wall>",
                      {Heading{2, "The run"}, Paragraph{"`v < c`, so *slow*; 2 * 3"}, Verbatim{"a < b\nc"},
                       Image{"my picture.png"}, Table{{"", "x|y"}, {{"Radius", "1 mm"}}},
                       Table{{"h", "n"}, {{"1", "2"}}, 0}, FileList{{{"a b.csv", "numbers"}}}}};

TEST(Document, AsMarkdown) {
  EXPECT_EQ(markdown(sample), "# Bar & <wall>\n\n"
                              "## The run\n\n"
                              "`v < c`, so *slow*; 2 * 3\n\n"
                              "    a < b\n    c\n\n"
                              "![my picture](my%20picture.png)\n\n"
                              "| | x\\|y |\n|:--|--:|\n| Radius | 1 mm |\n\n"
                              "| h | n |\n|--:|--:|\n| 1 | 2 |\n\n"
                              "- [a b.csv](a%20b.csv): numbers\n");
}

TEST(Document, AsOnePageWithItsPictures) {
  const TemporaryFolder folder;
  test::store(folder / "my picture.png", "abcd");
  const std::string page = html(sample, folder.path());
  for (const char* part :
       {"<title>Bar &amp; &lt;wall&gt;</title>", "<h1>Bar &amp; &lt;wall&gt;</h1>", "<h2>The run</h2>",
        "<p><code>v &lt; c</code>, so <em>slow</em>; 2 * 3</p>", "<pre>a &lt; b\nc</pre>",
        "<img alt=\"my picture\" src=\"data:image/png;base64,YWJjZA==\">", "<th>x|y</th>",
        "<tr><td class=\"words\">Radius</td><td>1 mm</td></tr>", "<tr><td>1</td><td>2</td></tr>",
        "<a href=\"a%20b.csv\">a b.csv</a>: numbers"})
    EXPECT_NE(page.find(part), std::string::npos) << part << " is not in\n" << page;
  for (const char* outside : {"http", "//", "<script", "url("})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
}

TEST(Document, AMissingPictureIsNamed) {
  const TemporaryFolder folder;
  try {
    html(sample, folder.path());
    FAIL();
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("my picture.png"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace tessera::post

/// A report as a sequence of blocks, written as Markdown or as one HTML file that needs no other.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tessera::post {

struct Heading {
  int level = 2; ///< 2 or 3; 1 is the document's title
  std::string text;
};

/// Running text, in which `code` and *stressed words* may stand.
struct Paragraph {
  std::string text;
};

/// Lines to be kept as they are.
struct Verbatim {
  std::string text;
};

/// A PNG of the document's folder.
struct Image {
  std::filesystem::path file; ///< relative to the folder
};

/// The first columns read from the left, numbers in all others line up on the right.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::size_t words = 1; ///< how many columns read from the left
};

/// Files of the document's folder, each with what it holds.
struct FileList {
  std::vector<std::pair<std::string, std::string>> files;
};

using Block = std::variant<Heading, Paragraph, Verbatim, Image, Table, FileList>;

struct Document {
  std::string title;
  std::vector<Block> blocks;
};

/// Images and files as relative links.
std::string markdown(const Document& document);

/// One page without scripts, outside links or other files: the images of `folder` lie in it. RunError where
/// one cannot be read.
std::string html(const Document& document, const std::filesystem::path& folder);

} // namespace tessera::post

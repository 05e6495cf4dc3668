// The table of a comparison as text.

#include "postprocess/compare.hpp"

#include <algorithm>

namespace tessera::post {
namespace {

std::size_t width_of(const std::string& utf8) {
  return static_cast<std::size_t>(std::count_if(
      utf8.begin(), utf8.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string air(width > width_of(text) ? width - width_of(text) : 0, ' ');
  return right ? air + text : text + air;
}

} // namespace

std::string table(const Comparison& comparison) {
  std::size_t label = 0;
  for (const std::string& row : comparison.rows)
    label = std::max(label, width_of(row));
  std::string text(label, ' ');
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    std::size_t width = width_of(comparison.runs[i]);
    for (const auto& values : comparison.values)
      width = std::max(width, width_of(values[i]));
    widths.push_back(width);
    text += "  " + padded(comparison.runs[i], width, true);
  }
  text += "\n";
  for (std::size_t r = 0; r < comparison.rows.size(); ++r) {
    text += padded(comparison.rows[r], label, false);
    for (std::size_t i = 0; i < widths.size(); ++i)
      text += "  " + padded(comparison.values[r][i], widths[i], true);
    text += "\n";
  }
  return text;
}

} // namespace tessera::post

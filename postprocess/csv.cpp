#include "postprocess/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace tessera::post {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos)
    return text;
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

} // namespace

std::string csv_line(const std::vector<std::string>& cells) {
  std::vector<std::string> safe(cells.size());
  std::transform(cells.begin(), cells.end(), safe.begin(), quoted);
  return fmt::format("{}\n", fmt::join(safe, ","));
}

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : "";
}

} // namespace tessera::post

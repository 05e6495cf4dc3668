#include "io/history.hpp"
#include "core/error.hpp"
#include "core/particle_cloud.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>

namespace tessera::io {
namespace {

namespace fs = std::filesystem;

std::string quoted(const std::string& name) {
  if (name.find_first_of(",\"\n\r") == std::string::npos)
    return name;
  std::string out = "\"";
  for (const char c : name) {
    if (c == '"')
      out += '"';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + '"';
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (inside && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += '"';
      ++i;
    } else if (line[i] == '"') {
      inside = !inside;
    } else if (line[i] == ',' && !inside) {
      cells.emplace_back();
    } else if (line[i] != '\r') {
      cells.back() += line[i];
    }
  }
  return cells;
}

std::optional<std::vector<double>> numbers(const std::string& line, std::size_t count) {
  const std::vector<std::string> cells = split(line);
  if (cells.size() != count)
    return std::nullopt;
  std::vector<double> values;
  for (const std::string& cell : cells) {
    char* end = nullptr;
    values.push_back(std::strtod(cell.c_str(), &end));
    if (cell.empty() || *end != '\0')
      return std::nullopt;
  }
  return values;
}

void flush(std::ofstream& out, const fs::path& file) {
  errno = 0;
  out.flush();
  if (out)
    return;
  throw RunError(fmt::format("cannot write: {}", errno ? std::strerror(errno) : "the stream failed"),
                 file.string(), "free some space or choose another output folder with -o");
}

} // namespace

HistoryFile::HistoryFile(const fs::path& file) : file_(file) {
  errno = 0;
  out_.open(file, std::ios::trunc);
  if (!out_)
    throw RunError(fmt::format("cannot write: {}", std::strerror(errno)), file.string(),
                   "check the folder's permissions or choose another output folder with -o");
}

void HistoryFile::columns(const std::vector<std::string>& names) {
  std::vector<std::string> cells;
  for (const std::string& name : names)
    cells.push_back(quoted(name));
  out_ << fmt::format("{}\n", fmt::join(cells, ","));
  flush(out_, file_);
}

void HistoryFile::row(const std::vector<double>& values) {
  out_ << fmt::format("{}\n", fmt::join(values, ","));
  flush(out_, file_);
}

const std::vector<double>& History::column(const std::string& name) const {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name)
      return columns[i];
  const std::string nearest = nearest_name(name, names);
  throw InputError(fmt::format("the history has no column '{}'", name), "",
                   fmt::format("{}it has: {}",
                               nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest),
                               fmt::join(names, ", ")));
}

// A run that was killed may have left half a row, which can look whole (0.12 of 0.125): only a line end
// proves it.
History read_history(const fs::path& file) {
  errno = 0;
  std::ifstream in(file);
  if (!in)
    throw InputError(fmt::format("cannot read: {}", std::strerror(errno)), file.string(),
                     "run the case first: 'tessera run CASE.toml -o DIR' writes it");
  History history;
  std::string line;
  int number = 1;
  while (std::getline(in, line) && line.starts_with('#'))
    ++number;
  require(in.good(), "the history has no line of column names", file.string(), "run the case again");
  history.names = split(line);
  history.columns.resize(history.names.size());
  while (std::getline(in, line) && !in.eof()) {
    ++number;
    if (line.empty())
      continue;
    const auto values = numbers(line, history.names.size());
    require(values.has_value(), fmt::format("a row does not hold {} numbers", history.names.size()),
            fmt::format("{}:{}", file.string(), number), "run the case again");
    for (std::size_t c = 0; c < values->size(); ++c)
      history.columns[c].push_back((*values)[c]);
  }
  return history;
}

} // namespace tessera::io

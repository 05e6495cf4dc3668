#include "core/error.hpp"

namespace tessera {
namespace {

std::string one_line(const std::string& what, const std::string& where, const std::string& remedy) {
  std::string line = what;
  if (!where.empty())
    line += ", " + where;
  if (!remedy.empty())
    line += ", " + remedy;
  for (char& c : line)
    if (c == '\n' || c == '\r')
      c = ' ';
  return line;
}

} // namespace

Error::Error(ExitStatus status, const std::string& what, const std::string& where, const std::string& remedy)
    : std::runtime_error(one_line(what, where, remedy)), status_(status) {}

} // namespace tessera

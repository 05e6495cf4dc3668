#include "preprocess/geometry/importer/request.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace tessera::importer {
namespace {

std::string as_text(const std::string& value) {
  return value;
}
std::string as_text(double value) {
  return fmt::format("{:a}", value);
}
std::string as_text(int value) {
  return std::to_string(value);
}
std::string as_text(bool value) {
  return value ? "1" : "0";
}
/// "box 3 1 2 3": the name, then each length's count and numbers.
std::string as_text(const std::optional<preprocess::ShapeSpec>& shape) {
  if (!shape)
    return {};
  std::string text = shape->name;
  for (const auto& length : shape->lengths) {
    text += fmt::format(" {}", length.size());
    for (const double x : length)
      text += fmt::format(" {:a}", x);
  }
  return text;
}

void from_text(const std::string& text, std::string& value) {
  value = text;
}
void from_text(const std::string& text, double& value) {
  value = std::strtod(text.c_str(), nullptr);
}
void from_text(const std::string& text, int& value) {
  value = std::atoi(text.c_str());
}
void from_text(const std::string& text, bool& value) {
  value = text == "1";
}
void from_text(const std::string& text, std::optional<preprocess::ShapeSpec>& value) {
  std::istringstream words(text);
  preprocess::ShapeSpec shape;
  if (!(words >> shape.name))
    return;
  std::size_t count = 0;
  while (words >> count) {
    auto& length = shape.lengths.emplace_back();
    std::string word; // streams do not read hexadecimal numbers
    while (length.size() < count && words >> word)
      length.push_back(std::strtod(word.c_str(), nullptr));
  }
  value = std::move(shape);
}

/// Every member under its key, for either direction.
template <class RequestT, class F>
void for_each_member(RequestT& request, F&& f) {
  f("file", request.file);
  f("name", request.name);
  f("output", request.output);
  f("metres", request.metres);
  f("cad_unit", request.cad_unit);
  f("tolerance", request.tolerance);
  f("mesh_size", request.mesh_size);
  f("dimension", request.dimension);
  f("solid", request.solid);
  f("close_holes", request.close_holes);
  f("background_sizes", request.background_sizes);
  f("shape", request.shape);
}

} // namespace

std::vector<std::string> to_arguments(const Request& request) {
  std::vector<std::string> arguments;
  for_each_member(request, [&](const char* key, const auto& value) {
    arguments.push_back(fmt::format("{}={}", key, as_text(value)));
  });
  return arguments;
}

Request from_arguments(std::span<const char* const> arguments) {
  Request request;
  for (const std::string argument : arguments) {
    const auto equals = argument.find('=');
    bool known = false;
    for_each_member(request, [&](const char* key, auto& value) {
      if (equals == std::string::npos || argument.compare(0, equals, key) != 0)
        return;
      from_text(argument.substr(equals + 1), value);
      known = true;
    });
    if (!known)
      throw std::invalid_argument("\"" + argument + "\" is not KEY=VALUE of a request");
  }
  return request;
}

} // namespace tessera::importer

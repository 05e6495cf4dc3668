#include "tests/unit/app/case_text.hpp"

#include "core/error.hpp"

#include <fstream>
#include <stdexcept>

namespace tessera::app {

const std::string complete_case = R"(title = "a bar"
[geometry]
file = "bar.step"
unit = "mm"
[particles]
arrangement = "lattice"
spacing = 0.001
[material]
law = "hencky"
density = 8930
young = 117e9
poisson = 0.35
[solver]
end_time = 80e-6
[[initial]]
velocity = [0, "10*Z/6", -227]
[[boundary]]
on = "base"
type = "clamped"
[[wall]]
plane = {point = [0, 0, 0], normal = [0, 0, 1]}
[[set]]
name = "base"
plane = {point = [0, 0, 0], normal = [0, 0, 1]}
[output]
frames = 4
[[output.probe]]
name = "length"
quantity = "z"
reduce = "extent"
[[output.picture]]
name = "strain"
field = "PlasticStrain"
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = complete_case;
  const std::size_t at = text.find(from);
  if (at == std::string::npos)
    throw std::logic_error("the complete case has no '" + from + "'");
  return text.replace(at, from.size(), to);
}

std::filesystem::path CaseFolder::file(const std::string& name, const std::string& text) const {
  std::ofstream(path() / name, std::ios::binary) << text;
  return path() / name;
}

Case read_text_case(const std::string& text, const std::vector<std::string>& overrides) {
  const CaseFolder folder;
  return read_case(folder.file("case.toml", text), overrides);
}

std::string message(const std::string& text, const std::vector<std::string>& overrides) {
  const CaseFolder folder;
  try {
    read_case(folder.file("case.toml", text), overrides);
  } catch (const InputError& e) {
    std::string line = e.what();
    const std::string prefix = folder.path().string() + "/";
    for (std::size_t at = line.find(prefix); at != std::string::npos; at = line.find(prefix))
      line.erase(at, prefix.size());
    return line;
  }
  return "no error";
}

} // namespace tessera::app

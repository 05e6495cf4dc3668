#include "tests/cli/small_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace tessera::cli {

const std::string small_case = R"(title = "small box"
[geometry]
file = "box.geo"
unit = "mm"
[particles]
arrangement = "lattice"
spacing = 0.0025
[material]
law = "hencky"
density = 8930
young = 117e9
poisson = 0.35
plasticity = {yield = 400e6, hardening = 100e6}
[solver]
jst4 = 0.000244140625
end_time = 5e-6
[[initial]]
velocity = [0, 0, -100]
[[wall]]
plane = {point = [0, 0, 0], normal = [0, 0, 1]}
[[set]]
name = "foot"
plane = {point = [0, 0, 0], normal = [0, 0, 1]}
[output]
frames = 3
history_rows = 20
[[output.probe]]
name = "length"
quantity = "z"
reduce = "extent"
[[output.probe]]
name = "foot_speed"
quantity = "vz"
reduce = "mean"
on = "foot"
)";

void write_small_case(const Workplace& place) {
  place.write("box.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 10, 10, 20};\n");
  place.write("case.toml", small_case);
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = small_case;
  const std::size_t at = text.find(from);
  if (at == std::string::npos)
    throw std::logic_error("the small case has no '" + from + "'");
  return text.replace(at, from.size(), to);
}

int line_of(const std::string& text) {
  const std::size_t at = small_case.find(text);
  if (at == std::string::npos)
    throw std::logic_error("the small case has no '" + text + "'");
  return 1 + static_cast<int>(
                 std::count(small_case.begin(), small_case.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

void expect_error(const Result& result, const std::vector<std::string>& pieces, int status) {
  EXPECT_EQ(result.status, status) << result.err;
  EXPECT_EQ(result.out, "");
  const std::vector<std::string> said = lines(result.err);
  ASSERT_FALSE(said.empty()) << "nothing on standard error";
  EXPECT_EQ(said.size(), 1U) << result.err;
  EXPECT_TRUE(said.back().starts_with("error: ")) << said.back();
  for (const std::string& piece : pieces)
    EXPECT_NE(said.back().find(piece), std::string::npos) << "'" << piece << "' is not in: " << said.back();
}

} // namespace tessera::cli

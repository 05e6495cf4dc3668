/// A block as an IGES 5.3 file of trimmed planes (entities 144, 142, 102, 110 on 128), as surface modellers
/// write.
#pragma once

#include "core/tensor.hpp"

#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

namespace tessera::test {

/// Collects entities and lays them out in the five sections of 80 columns.
class IgesFile {
 public:
  /// Number of the entity's directory entry, by which others point to it. `dependent`: part of another one.
  int add(int type, const std::string& parameters, bool dependent) {
    const int entry = 2 * static_cast<int>(count_) + 1;
    std::vector<std::string> lines{""};
    std::string text = fmt::format("{},{};", type, parameters);
    for (std::size_t at = 0; at < text.size();) { // a number must not be broken
      std::size_t end = text.find_first_of(",;", at) + 1;
      if (lines.back().size() + end - at > 64)
        lines.emplace_back();
      lines.back() += text.substr(at, end - at);
      at = end;
    }
    directory_ +=
        fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}D{:>7}\n", type, parameter_lines_ + 1, 0, 0,
                    0, 0, 0, 0, dependent ? "00010000" : "00000000", entry);
    directory_ += fmt::format("{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}D{:>7}\n", type, 0, 0,
                              lines.size(), 0, "", "", "", 0, entry + 1);
    for (const std::string& line : lines)
      parameters_ += fmt::format("{:<64}{:>8}P{:>7}\n", line, entry, ++parameter_lines_);
    ++count_;
    return entry;
  }
  /// `flag` and `unit` are parameters 14 and 15 of the global section.
  std::string text(int flag, const std::string& unit) const {
    const std::string hollerith = unit.empty() ? "" : fmt::format("{}H{}", unit.size(), unit);
    const std::string global = fmt::format("1H,,1H;,4Htest,8Hbox.iges,7HTessera,3H1.0,32,38,6,308,15,4Htest,"
                                           "1.0,{},{},1,0.01,15H20260101.000000,1E-6,"
                                           "10.0,4HNone,4HNone,11,0,15H20260101.000000;",
                                           flag, hollerith);
    std::string text = fmt::format("{:<72}S{:>7}\n", "A block of trimmed planes.", 1);
    int lines = 0;
    for (std::size_t at = 0; at < global.size(); at += 72)
      text += fmt::format("{:<72}G{:>7}\n", global.substr(at, 72), ++lines);
    text += directory_ + parameters_;
    return text + fmt::format("{:<72}T{:>7}\n",
                              fmt::format("S{:>7}G{:>7}D{:>7}P{:>7}", 1, lines, 2 * count_, parameter_lines_),
                              1);
  }

 private:
  std::size_t count_ = 0;
  int parameter_lines_ = 0;
  std::string directory_, parameters_;
};

/// The block from 0 to `size` with its first `faces` faces (x = 0, x = size, y = 0...), from `first` on.
inline std::string iges_box(const Vec3& size, int faces = 6, int flag = 2, const std::string& unit = "MM",
                            int first = 0) {
  IgesFile file;
  const auto point = [](const Vec3& X) { return fmt::format("{:.9E},{:.9E},{:.9E}", X[0], X[1], X[2]); };
  for (int f = first; f < faces; ++f) {
    const int axis = f / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<Vec3, 4> X; // around the face
    for (int c = 0; c < 4; ++c) {
      X[c].setZero();
      X[c][axis] = f % 2 == 0 ? 0 : size[axis];
      X[c][u] = c == 1 || c == 2 ? size[u] : 0;
      X[c][v] = c >= 2 ? size[v] : 0;
    }
    const int plane =
        file.add(128,
                 fmt::format("1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,{},{},{},{},0.,1.,0.,1.",
                             point(X[0]), point(X[1]), point(X[3]), point(X[2])),
                 true);
    std::string lines;
    for (int c = 0; c < 4; ++c)
      lines +=
          fmt::format(",{}", file.add(110, fmt::format("{},{}", point(X[c]), point(X[(c + 1) % 4])), true));
    const int loop = file.add(102, "4" + lines, true);
    const int boundary = file.add(142, fmt::format("0,{},0,{},2", plane, loop), true);
    file.add(144, fmt::format("{},1,0,{}", plane, boundary), false);
  }
  return file.text(flag, unit);
}

} // namespace tessera::test

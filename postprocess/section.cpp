#include "postprocess/section.hpp"

#include "core/error.hpp"
#include "postprocess/csv.hpp"
#include "postprocess/quantity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

namespace tessera::post {
namespace {

/// "x,y,z" or "x,y"; nothing where it is not.
std::optional<Vec3> point_from(std::string_view text) {
  Vec3 point = Vec3::Zero();
  for (int c = 0; c < 3; ++c) {
    const std::string_view word = text.substr(0, text.find(','));
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), point[c]);
    if (error != std::errc() || stop != word.data() + word.size() || !std::isfinite(point[c]))
      return std::nullopt;
    if (word.size() == text.size())
      return c > 0 ? std::optional(point) : std::nullopt;
    text.remove_prefix(word.size() + 1);
  }
  return std::nullopt; // a fourth
}

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values)
    value *= factor;
  return values;
}

} // namespace

Section section_from(const std::string& text) {
  const auto colon = text.find(':');
  const auto from = point_from(std::string_view(text).substr(0, colon));
  const auto to =
      colon == std::string::npos ? std::nullopt : point_from(std::string_view(text).substr(colon + 1));
  require(from && to && *from != *to, fmt::format("'{}' is no section", text), "",
          "give two points in metres: x0,y0,z0:x1,y1,z1");
  return {*from, *to, std::count(text.begin(), text.end(), ',') == 4};
}

SectionCurves cut(const Section& section, const std::vector<Snapshot>& runs,
                  const std::vector<std::string>& fields, Configuration configuration, int samples) {
  require(section.in_space || runs.front().cloud.dimension == 2, "a section through a body in space has no z",
          "", "give two points in metres: x0,y0,z0:x1,y1,z1");
  SectionCurves out;
  for (int i = 0; i < samples; ++i) {
    const double t = static_cast<double>(i) / (samples - 1);
    out.points.push_back((1 - t) * section.from + t * section.to);
    out.distance.push_back(t * (section.to - section.from).norm());
  }
  std::vector<std::vector<std::optional<solver::Sampling>>> at;
  for (const Snapshot& run : runs)
    at.push_back(samplings(run, out.points, configuration));
  for (const std::string& name : fields)
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const io::StoredField field = field_of(runs[r], name);
      SectionCurves::Curve& curve = out.curves.emplace_back(SectionCurves::Curve{name, r, {}});
      for (const auto& point : at[r]) {
        const Eigen::VectorXd value = point ? value_at(field, *point) : Eigen::VectorXd();
        curve.values.push_back(!point              ? std::numeric_limits<double>::quiet_NaN()
                               : value.size() == 1 ? value[0]
                                                   : value.norm());
      }
    }
  const auto seen = [](const auto& curve) {
    return std::count_if(curve.values.begin(), curve.values.end(),
                         [](double value) { return std::isfinite(value); }) > 1;
  };
  require(std::any_of(out.curves.begin(), out.curves.end(), seen),
          fmt::format("the section from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g}) m does not meet "
                      "the body",
                      section.from[0], section.from[1], section.from[2], section.to[0], section.to[1],
                      section.to[2]),
          "", "give points in metres, in the deformed body or, with --reference, in the body as it was");
  return out;
}

std::vector<Chart> charts_of(const SectionCurves& curves, const std::vector<std::string>& names,
                             const std::string& title) {
  const Unit length = readable_unit("m", curves.distance.back());
  std::vector<Chart> charts;
  std::vector<Unit> units;
  for (const auto& curve : curves.curves) {
    const Quantity quantity = field_quantity(curve.field);
    if (curve.run == 0) {
      double most = 0;
      for (const auto& other : curves.curves)
        if (other.field == curve.field)
          most = std::max(most, largest_magnitude(other.values));
      units.push_back(readable_unit(quantity.unit, most));
      charts.push_back({title,
                        titled("Distance along the section", length.name),
                        titled(quantity.label, units.back().name),
                        false,
                        false,
                        {}});
    }
    const bool dashed = curve.run >= 8; // where the colours begin again
    charts.back().curves.push_back({names[curve.run], scaled(curves.distance, length.factor),
                                    scaled(curve.values, units.back().factor), false, dashed});
  }
  return charts;
}

std::string csv_text(const SectionCurves& curves, const std::vector<std::string>& names) {
  std::vector<std::string> cells{"distance_m", "x_m", "y_m", "z_m"};
  for (const auto& curve : curves.curves)
    cells.push_back(field_column(curve.field) + " " + names[curve.run]);
  std::string text = csv_line(cells);
  for (std::size_t i = 0; i < curves.points.size(); ++i) {
    cells = {csv_number(curves.distance[i])};
    for (int c = 0; c < 3; ++c)
      cells.push_back(csv_number(curves.points[i][c]));
    for (const auto& curve : curves.curves)
      cells.push_back(csv_number(curve.values[i]));
    text += csv_line(cells);
  }
  return text;
}

} // namespace tessera::post

#include "app/hyperbolicity_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tessera::app {
namespace {

using Json = nlohmann::ordered_json;
using solver::Hyperbolicity;
using solver::StretchPath;
using solver::StretchRegion;

/// A path whose equilibria end before the range does.
bool ends_early(double end) {
  return std::abs(std::log(end)) < std::log(solver::stretch_range) - 1e-9;
}

/// "0.8744" lost there, "(0.396)" the path's equilibria end there, "-" neither.
std::string loss_text(const std::optional<solver::StretchPoint>& loss, double end) {
  return loss ? fmt::format("{:.4f}", loss->stretch) : ends_early(end) ? fmt::format("({:.3f})", end) : "-";
}

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

Json path_json(const StretchPath& path) {
  const auto stretch = [](const std::optional<solver::StretchPoint>& point) {
    return point ? Json(point->stretch) : Json();
  };
  return {{"lost_below", stretch(path.lost_below)},
          {"lost_above", stretch(path.lost_above)},
          {"from", path.points.front().stretch},
          {"to", path.points.back().stretch}};
}

Json region_json(const StretchRegion& region) {
  return {{"lost_fraction", region.lost_fraction}, {"edge", region.edge}};
}

/// Where a law keeps its waves throughout there is no edge to draw.
post::Chart region_chart(const std::vector<Hyperbolicity>& laws, std::size_t region,
                         const std::string& title) {
  post::Chart chart{title, "Stretch 1", "Stretch 2", true, true, {}};
  for (const Hyperbolicity& study : laws) {
    const StretchRegion& found = study.regions[region];
    if (found.lost_fraction == 0)
      continue;
    post::Curve curve;
    curve.label = study.subject.label;
    for (const auto& [first, second] : found.edge) {
      curve.x.push_back(first);
      curve.y.push_back(second);
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

post::Chart path_chart(const std::vector<Hyperbolicity>& laws, std::size_t path, const std::string& title) {
  constexpr double lowest = -1, highest = 2; // beyond these the curves say no more
  post::Chart chart{title, "Stretch", "Modulus / shear modulus at rest", true, false, {}};
  for (const Hyperbolicity& study : laws) {
    if (study.subject.law == "linear_elastic") // whose waves know nothing of strain
      continue;
    post::Curve curve;
    curve.label = study.subject.label;
    for (const solver::StretchPoint& point : study.paths[path].points) {
      curve.x.push_back(point.stretch);
      curve.y.push_back(point.slowest < lowest || point.slowest > highest
                            ? std::numeric_limits<double>::quiet_NaN()
                            : point.slowest);
    }
    curve.dashed = chart.curves.size() >= 8; // where the colours begin again
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

} // namespace

std::string hyperbolicity_table(const std::vector<Hyperbolicity>& laws) {
  std::string text = fmt::format(
      "Principal stretches {:g} to {:g}. Lost: the part of them where some wave is not real, of all, in "
      "plane "
      "strain and at J = 1.\nThen the first stretch under and over 1 where that is so along each path; in "
      "brackets, where the equilibria that begin at rest end.\n\n{:<25}{:>8}{:>8}{:>8}",
      1 / solver::stretch_range, solver::stretch_range, "", "lost", "plane", "J = 1");
  for (const std::string& path : solver::stretch_paths())
    text += fmt::format("{:>17}", path);
  text += "    lost at J\n";
  for (const Hyperbolicity& study : laws) {
    text +=
        fmt::format("{:<25}{:>6.1f} %{:>6.1f} %{:>6.1f} %", study.subject.label, 100 * study.lost_fraction,
                    100 * study.regions[0].lost_fraction, 100 * study.regions[1].lost_fraction);
    for (const StretchPath& path : study.paths)
      text += fmt::format("{:>9}{:>8}", loss_text(path.lost_below, path.points.front().stretch),
                          loss_text(path.lost_above, path.points.back().stretch));
    std::string volume;
    if (study.regions[1].lost_fraction > 0)
      volume = " any";
    else {
      if (study.lost_compressed)
        volume = fmt::format(" <= {:.2f}", *study.lost_compressed);
      if (study.lost_swollen)
        volume += fmt::format(" >= {:.2f}", *study.lost_swollen);
    }
    text += fmt::format("   {}\n", volume.empty() ? " none" : volume);
  }
  return text;
}

std::string hyperbolicity_csv(const std::vector<Hyperbolicity>& laws) {
  std::string text = "label,law,path,stretch,stretch_1,stretch_2,stretch_3,slowest_over_mu\n";
  for (const Hyperbolicity& study : laws)
    for (const StretchPath& path : study.paths)
      for (const solver::StretchPoint& point : path.points)
        text += fmt::format("\"{}\",{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}\n", study.subject.label,
                            study.subject.law, path.name, point.stretch, point.stretches[0],
                            point.stretches[1], point.stretches[2], point.slowest);
  return text;
}

std::string hyperbolicity_json(const std::vector<Hyperbolicity>& laws) {
  Json json = {{"stretches", {1 / solver::stretch_range, solver::stretch_range}}, {"laws", Json::array()}};
  for (const Hyperbolicity& study : laws) {
    Json entry = {{"label", study.subject.label},
                  {"law", study.subject.law},
                  {"constants", study.subject.constants},
                  {"mu_Pa", study.subject.mu},
                  {"lost_fraction", study.lost_fraction},
                  {"lost_at_J_below_1", number_or_null(study.lost_compressed)},
                  {"lost_at_J_from_1", number_or_null(study.lost_swollen)},
                  {"paths", Json::object()},
                  {"regions", Json::object()}};
    for (const StretchPath& path : study.paths)
      entry["paths"][path.name] = path_json(path);
    for (const StretchRegion& region : study.regions)
      entry["regions"][region.name] = region_json(region);
    json["laws"].push_back(std::move(entry));
  }
  return json.dump(1) + "\n";
}

post::Plot hyperbolicity_plot(const std::vector<Hyperbolicity>& laws, const std::filesystem::path& file) {
  post::Plot plot;
  plot.file = std::filesystem::absolute(file).string();
  plot.charts = {region_chart(laws, 0, "Where waves cease to be real: plane strain, stretch 3 = 1"),
                 region_chart(laws, 1, "Where waves cease to be real: volume kept, J = 1"),
                 path_chart(laws, 0, "Slowest wave of any direction under uniaxial stress")};
  return plot;
}

} // namespace tessera::app

#include "postprocess/report.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "io/atomic_file.hpp"
#include "io/cloud_file.hpp"
#include "io/history.hpp"
#include "postprocess/cloud_picture.hpp"
#include "postprocess/history_charts.hpp"
#include "postprocess/picture.hpp"
#include "postprocess/quantity.hpp"
#include "postprocess/render_job.hpp"
#include "postprocess/run_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace tessera::post {
namespace {

namespace fs = std::filesystem;

std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string figure_table(const std::vector<Figure>& figures) {
  std::string text = "| | |\n|:--|--:|\n";
  for (const Figure& figure : figures) {
    if (figure.key == "title")
      continue;
    const Unit unit = figure.key == "wall_seconds"
                          ? Unit{1, "s"}
                          : readable_unit(figure.unit, std::abs(figure.value.value_or(0)));
    text += fmt::format("| {} | {}{}{} |\n", cell(figure.label), cell(shown(figure, unit.factor)),
                        unit.name.empty() ? "" : " ", unit.name);
  }
  return text;
}

/// The pictures of the folder: fields first, then the curves, the cloud last.
std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> pictures;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".png" && entry.path().stem() != "cloud_histograms" &&
        !entry.path().filename().string().starts_with("."))
      pictures.push_back(entry.path().filename());
  const auto rank = [](const fs::path& picture) {
    const std::string name = picture.stem().string();
    return name == "cloud" ? 3 : name == "probes" ? 1 : name == "energies" ? 2 : 0;
  };
  std::sort(pictures.begin(), pictures.end(), [&](const fs::path& a, const fs::path& b) {
    return rank(a) != rank(b) ? rank(a) < rank(b) : a < b;
  });
  return pictures;
}

/// A relative link that survives spaces and brackets in the name.
std::string link(const fs::path& picture) {
  std::string out;
  for (const char c : picture.string())
    out += std::string_view(" ()<>%").find(c) == std::string_view::npos
               ? std::string(1, c)
               : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return out;
}

std::string title_of(const fs::path& folder, const std::vector<Figure>& summary, const std::string& asked) {
  for (const char* key : {"title", "case"})
    if (const Figure* figure = find_figure(summary, key); figure && !figure->text.empty())
      return figure->text;
  return asked.empty() ? fs::weakly_canonical(folder).filename().string() : asked;
}

/// The cloud of a folder with what tells how even it is.
struct StoredCloud {
  ParticleCloud cloud;
  Evenness even;
};

/// None where there is no cloud.vtp, or, with a note, where it cannot be read.
std::optional<StoredCloud> stored_cloud(const fs::path& folder, Progress& progress) {
  const fs::path file = folder / "cloud.vtp";
  if (!fs::exists(file))
    return std::nullopt;
  try {
    StoredCloud stored{io::read_cloud(file), {}};
    stored.even = evenness(stored.cloud);
    return stored;
  } catch (const Error& error) {
    progress.note(fmt::format("the report leaves the cloud out: {}", error.what()));
    return std::nullopt;
  }
}

std::string cloud_text(const fs::path& folder, const std::optional<StoredCloud>& stored) {
  std::vector<Figure> figures;
  std::vector<Figure> sets;
  if (stored) {
    const ParticleCloud& cloud = stored->cloud;
    figures.push_back({"arrangement", "Arrangement", "", cloud.arrangement, std::nullopt});
    figures.push_back({"subvolumes", "Subvolumes", "", cloud.subvolumes, std::nullopt});
    if (cloud.arrangement != "lattice")
      figures.push_back({"seed", "Seed", "", std::to_string(cloud.seed), static_cast<double>(cloud.seed)});
    figures.push_back({"spacing", "Nominal spacing h", "m", fmt::format("{}", cloud.spacing), cloud.spacing});
  }
  for (const Figure& figure : quality_figures(folder))
    (figure.key.starts_with("sets.") ? sets : figures).push_back(figure);
  if (figures.empty())
    return "";
  std::string text = "## The particles\n\n" + figure_table(figures) + "\n";
  if (stored && stored->cloud.dimension == 2)
    text += "The body is plane: volumes are areas, for a thickness of one metre.\n\n";
  if (!sets.empty())
    text += "### Sets\n\n" + figure_table(sets) + "\n";
  if (stored) {
    text += "### How even they are\n\n";
    if (fs::exists(folder / "cloud_histograms.png"))
      text += "![cloud_histograms](cloud_histograms.png)\n\n";
    text += evenness_tables(stored->even) + "\n";
  }
  return text;
}

std::string paraview_text(const fs::path& folder, const std::vector<Figure>& summary) {
  if (!fs::exists(folder / "fields.pvd"))
    return "";
  const Figure* spacing = find_figure(summary, "spacing");
  const std::string radius =
      spacing && spacing->value ? fmt::format(", *Gaussian Radius* {:.3g}", 0.5 * *spacing->value) : "";
  return fmt::format(
      "## In ParaView\n\n"
      "    paraview fields.pvd\n\n"
      "*Apply*, then *Representation*: Point Gaussian{}, *Shader Preset*: Sphere, and colour by a field. "
      "The points lie where the particles are at each time, so no *Warp* is needed; points minus "
      "`Displacement` are the reference positions. All values are in SI units.\n\n",
      radius);
}

std::string report_text(const fs::path& folder, const std::string& title, const std::vector<Figure>& summary,
                        const std::optional<StoredCloud>& cloud) {
  std::string text = fmt::format("# {}\n\n", title);
  if (summary.empty() && fs::exists(folder / "history.csv"))
    text += "The run did not reach its end: what follows is drawn from the frames it stored.\n\n";
  for (const fs::path& picture : pictures_in(folder))
    text += fmt::format("![{}]({})\n\n", picture.stem().string(), link(picture));
  if (!summary.empty())
    text += "## The run\n\n" + figure_table(summary) + "\n";
  text += cloud_text(folder, cloud);
  text += paraview_text(folder, summary);
  text += "## Files\n\n";
  const std::pair<const char*, const char*> files[] = {
      {"case.toml", "the case as it was run"},
      {"summary.json", "the figures above, SI units"},
      {"history.csv", "energies, momenta and probes against time"},
      {"fields.pvd", "the frames, for ParaView"},
      {"cloud.vtp", "the particles before the run, for ParaView and for `--cloud`"},
      {"cells.vtu", "their Voronoi cells"},
      {"quality.json", "the figures of the particles"}};
  for (const auto& [name, meaning] : files)
    if (fs::exists(folder / name))
      text += fmt::format("- [{}]({}): {}\n", name, name, meaning);
  return text;
}

/// energies.png and probes.png from history.csv, where there is one.
std::vector<Plot> history_plots(const fs::path& folder, const std::string& title, Progress& progress) {
  if (!fs::exists(folder / "history.csv"))
    return {};
  io::History history;
  try {
    history = io::read_history(folder / "history.csv");
    history.column("time_s");
  } catch (const Error& error) {
    progress.note(fmt::format("no curves: {}", error.what()));
    return {};
  }
  if (history.column("time_s").size() < 2)
    return {};
  Plot energies{fs::absolute(folder / "energies.png").string(), energy_charts(title + ": energies", history)};
  Plot probes{fs::absolute(folder / "probes.png").string(), {}};
  for (const std::string& column : probe_columns(history))
    probes.charts.push_back(chart_over_time(column_quantity(column).label, column, {{"", &history}}));
  std::vector<Plot> plots;
  for (Plot& plot : std::vector<Plot>{energies, probes})
    if (!plot.charts.empty())
      plots.push_back(std::move(plot));
  return plots;
}

/// Draws `drawings` and all plots of the folder in one child process and writes report.md.
std::vector<fs::path> write_all(const fs::path& folder, const std::string& asked_title,
                                std::vector<Drawing> drawings, const std::optional<StoredCloud>& cloud,
                                Progress& progress) {
  const std::vector<Figure> summary =
      fs::exists(folder / "summary.json") ? summary_figures(folder) : std::vector<Figure>{};
  const std::string title = title_of(folder, summary, asked_title);
  RenderJob job{std::move(drawings), history_plots(folder, title, progress)};
  if (cloud)
    job.plots.push_back(histogram_plot(folder, cloud->cloud, cloud->even));
  std::vector<fs::path> files = render(job, progress);
  io::write_text(folder / "report.md", report_text(folder, title, summary, cloud));
  files.push_back(folder / "report.md");
  return files;
}

} // namespace

std::vector<fs::path> write_report(const fs::path& folder, Progress& progress, const std::string& title) {
  require(fs::exists(folder / "summary.json") || fs::exists(folder / "history.csv") ||
              fs::exists(folder / "quality.json") || fs::exists(folder / "fields.pvd"),
          "no run is stored here", folder.string(),
          fmt::format("run the case first: tessera run CASE.toml -o {}", folder.string()));
  return write_all(folder, title, {}, stored_cloud(folder, progress), progress);
}

std::vector<fs::path> write_cloud_report(const fs::path& folder, Progress& progress, const std::string& title,
                                         const CellMesh* cells) {
  const std::optional<StoredCloud> cloud = stored_cloud(folder, progress);
  std::vector<Drawing> drawings;
  std::optional<CellsOnDisk> polyhedra;
  if (cloud) {
    polyhedra.emplace(folder, cloud->cloud, cells, progress);
    drawings.push_back(cloud_drawing(folder, cloud->cloud, polyhedra->file()));
  }
  return write_all(folder, title, std::move(drawings), cloud, progress);
}

} // namespace tessera::post

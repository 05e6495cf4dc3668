#include "postprocess/report.hpp"

#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "io/atomic_file.hpp"
#include "io/bytes.hpp"
#include "io/cloud_file.hpp"
#include "io/history.hpp"
#include "postprocess/cloud_picture.hpp"
#include "postprocess/document.hpp"
#include "postprocess/history_charts.hpp"
#include "postprocess/picture.hpp"
#include "postprocess/quantity.hpp"
#include "postprocess/render_job.hpp"
#include "postprocess/run_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace tessera::post {
namespace {

namespace fs = std::filesystem;

Table figure_table(const std::vector<Figure>& figures) {
  Table table{{"", ""}, {}};
  for (const Figure& figure : figures) {
    const Unit unit = figure.unit == "s" && figure.key.ends_with("_seconds")
                          ? Unit{1, "s"}
                          : readable_unit(figure.unit, std::abs(figure.value.value_or(0)));
    const std::string value = shown(figure, unit.factor);
    table.rows.push_back({figure.label, unit.name.empty() ? value : fmt::format("{} {}", value, unit.name)});
  }
  return table;
}

/// The pictures of the folder: fields first, then the curves, the cloud last.
std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> pictures;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".png" && entry.path().stem() != "cloud_histograms" &&
        !entry.path().filename().string().starts_with("."))
      pictures.push_back(entry.path().filename());
  const auto rank = [](const fs::path& picture) {
    constexpr std::string_view last[] = {"probes", "forces", "energies", "momenta", "cloud"};
    const auto found = std::find(std::begin(last), std::end(last), picture.stem().string());
    return found == std::end(last) ? -1 : found - std::begin(last);
  };
  std::sort(pictures.begin(), pictures.end(), [&](const fs::path& a, const fs::path& b) {
    return rank(a) != rank(b) ? rank(a) < rank(b) : a < b;
  });
  return pictures;
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

/// The figures of a run under the heads a reader looks for.
void add_run(Document& report, const std::vector<Figure>& summary) {
  const std::pair<const char*, std::vector<std::string_view>> heads[] = {
      {"What came out", {"max.", "min.", "extent.", "probes."}},
      {"Errors against the closed form", {"error."}},
      {"Energies", {"energy."}},
      {"Momenta", {"momentum."}},
      {"Cost",
       {"wall_seconds", "cpu_seconds", "setup_seconds", "us_per_particle_step", "threads",
        "bytes_per_particle", "peak_bytes"}}};
  std::vector<Figure> rest = summary;
  std::erase_if(rest, [](const Figure& figure) { return figure.key == "title"; });
  std::vector<std::pair<const char*, std::vector<Figure>>> groups;
  for (const auto& [head, keys] : heads) {
    const auto belongs = [&](const Figure& figure) {
      return std::any_of(keys.begin(), keys.end(),
                         [&](std::string_view key) { return figure.key.starts_with(key); });
    };
    auto& group = groups.emplace_back(head, std::vector<Figure>{}).second;
    std::copy_if(rest.begin(), rest.end(), std::back_inserter(group), belongs);
    std::erase_if(rest, belongs);
  }
  report.blocks.push_back(Heading{2, "The run"});
  report.blocks.push_back(figure_table(rest));
  for (const auto& [head, figures] : groups)
    if (!figures.empty()) {
      report.blocks.push_back(Heading{3, head});
      report.blocks.push_back(figure_table(figures));
    }
}

void add_cloud(Document& report, const fs::path& folder, const std::optional<StoredCloud>& stored) {
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
    return;
  report.blocks.push_back(Heading{2, "The particles"});
  report.blocks.push_back(figure_table(figures));
  if (stored && stored->cloud.dimension == 2)
    report.blocks.push_back(Paragraph{"The body is plane: volumes are areas, for a thickness of one metre."});
  if (!sets.empty()) {
    report.blocks.push_back(Heading{3, "Sets"});
    report.blocks.push_back(figure_table(sets));
  }
  if (stored) {
    report.blocks.push_back(Heading{3, "How even they are"});
    if (fs::exists(folder / "cloud_histograms.png"))
      report.blocks.push_back(Image{"cloud_histograms.png"});
    for (Table& table : evenness_tables(stored->even))
      report.blocks.push_back(std::move(table));
  }
}

void add_paraview(Document& report, const fs::path& folder, const std::vector<Figure>& summary) {
  if (!fs::exists(folder / "fields.pvd"))
    return;
  const Figure* spacing = find_figure(summary, "spacing");
  const std::string radius =
      spacing && spacing->value ? fmt::format(", *Gaussian Radius* {:.3g}", 0.5 * *spacing->value) : "";
  report.blocks.push_back(Heading{2, "In ParaView"});
  report.blocks.push_back(Verbatim{"paraview fields.pvd"});
  report.blocks.push_back(Paragraph{fmt::format(
      "*Apply*, then *Representation*: Point Gaussian{}, *Shader Preset*: Sphere, and colour by a field. "
      "The points lie where the particles are at each time, so no *Warp* is needed; points minus "
      "`Displacement` are the reference positions. All values are in SI units.",
      radius)});
}

/// The case as it was run, with what tells it from any other.
void add_case(Document& report, const fs::path& folder) {
  const fs::path file = folder / "case.toml";
  if (!fs::exists(file))
    return;
  const std::string text = io::read_bytes(file);
  report.blocks.push_back(Heading{2, "The case"});
  report.blocks.push_back(Paragraph{fmt::format("`case.toml`, SHA-256 `{}`:", io::sha256(text))});
  report.blocks.push_back(Verbatim{text});
}

void add_files(Document& report, const fs::path& folder) {
  const std::pair<const char*, const char*> known[] = {
      {"case.toml", "the case as it was run"},
      {"summary.json", "the figures above, SI units"},
      {"history.csv", "energies, momenta, forces and probes against time"},
      {"fields.pvd", "the frames, for ParaView"},
      {"cloud.vtp", "the particles before the run, for ParaView and for --cloud"},
      {"body.vtu", "the shape of the undeformed body"},
      {"cells.vtu", "their Voronoi cells"},
      {"quality.json", "the figures of the particles"}};
  FileList list;
  for (const auto& [name, meaning] : known)
    if (fs::exists(folder / name))
      list.files.emplace_back(name, meaning);
  report.blocks.push_back(Heading{2, "Files"});
  report.blocks.push_back(std::move(list));
}

Document report_of(const fs::path& folder, const std::string& title, const std::vector<Figure>& summary,
                   const std::optional<StoredCloud>& cloud) {
  Document report{title, {}};
  if (summary.empty() && fs::exists(folder / "history.csv"))
    report.blocks.push_back(
        Paragraph{"The run did not reach its end: what follows is drawn from the frames it stored."});
  for (const fs::path& picture : pictures_in(folder))
    report.blocks.push_back(Image{picture});
  if (!summary.empty())
    add_run(report, summary);
  add_cloud(report, folder, cloud);
  add_paraview(report, folder, summary);
  add_case(report, folder);
  add_files(report, folder);
  return report;
}

/// energies.png, momenta.png, forces.png and probes.png (of what is not zero throughout) from history.csv,
/// where there is one.
std::vector<Plot> history_plots(const fs::path& folder, const std::string& title, bool plane,
                                Progress& progress) {
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
  const std::string per = plane ? ", per metre of thickness" : "";
  const auto plot = [&](const char* name, std::vector<Chart> charts) {
    return Plot{fs::absolute(folder / name).string(), std::move(charts)};
  };
  Plot probes{fs::absolute(folder / "probes.png").string(), {}};
  for (const std::string& column : probe_columns(history)) {
    const std::vector<double>& values = history.column(column);
    if (std::any_of(values.begin(), values.end(), [](double value) { return value != 0; }))
      probes.charts.push_back(chart_over_time(column_quantity(column).label, column, {{"", &history}}));
  }
  std::vector<Plot> plots;
  for (Plot& drawn :
       std::vector<Plot>{plot("energies.png", energy_charts(title + ": energies", history, per)),
                         plot("momenta.png", momentum_charts(title + ": momenta", history, per)),
                         plot("forces.png", force_charts(history, per)), probes})
    if (!drawn.charts.empty())
      plots.push_back(std::move(drawn));
  return plots;
}

/// Draws `drawings` and all plots of the folder in one child process and writes both reports.
std::vector<fs::path> write_all(const fs::path& folder, const std::string& asked_title,
                                std::vector<Drawing> drawings, const std::optional<StoredCloud>& cloud,
                                Progress& progress) {
  const std::vector<Figure> summary =
      fs::exists(folder / "summary.json") ? summary_figures(folder) : std::vector<Figure>{};
  const std::string title = title_of(folder, summary, asked_title);
  RenderJob job{std::move(drawings),
                history_plots(folder, title, cloud && cloud->cloud.dimension == 2, progress)};
  if (cloud)
    job.plots.push_back(histogram_plot(folder, cloud->cloud, cloud->even));
  std::vector<fs::path> files = render(job, progress);
  const Document report = report_of(folder, title, summary, cloud);
  io::write_text(folder / "report.md", markdown(report));
  io::write_text(folder / "report.html", html(report, folder));
  files.insert(files.end(), {folder / "report.md", folder / "report.html"});
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

#include "postprocess/compare.hpp"

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/history.hpp"
#include "postprocess/document.hpp"
#include "postprocess/history_charts.hpp"
#include "postprocess/quantity.hpp"
#include "postprocess/render_job.hpp"
#include "postprocess/run_figures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace tessera::post {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

/// One row: the same figure of every run, nullptr where a run has none.
struct Row {
  std::string key, label, unit;
  std::vector<const Figure*> runs;
};

std::vector<std::string> distinct_names(const std::vector<fs::path>& folders) {
  std::vector<fs::path> whole;
  for (const fs::path& folder : folders)
    whole.push_back(fs::weakly_canonical(folder));
  std::vector<std::string> names;
  for (const fs::path& path : whole) {
    const auto same = [&](const fs::path& other) { return other.filename() == path.filename(); };
    const bool alone = std::count_if(whole.begin(), whole.end(), same) == 1;
    const std::string name =
        alone ? path.filename().string() : (path.parent_path().filename() / path.filename()).string();
    std::string unique = name;
    for (int i = 2; std::find(names.begin(), names.end(), unique) != names.end(); ++i)
      unique = fmt::format("{} ({})", name, i);
    names.push_back(unique);
  }
  return names;
}

/// Keys in the order of the first run, those only others have at the place where they come there.
std::vector<Row> rows_of(const std::vector<std::vector<Figure>>& runs) {
  std::vector<Row> rows;
  for (const auto& figures : runs) {
    std::size_t place = 0;
    for (const Figure& figure : figures) {
      const auto known =
          std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.key == figure.key; });
      if (known == rows.end())
        rows.insert(rows.begin() + static_cast<std::ptrdiff_t>(place++),
                    {figure.key, figure.label, figure.unit, {}});
      else
        place = static_cast<std::size_t>(known - rows.begin()) + 1;
    }
  }
  for (Row& row : rows)
    for (const auto& figures : runs)
      row.runs.push_back(find_figure(figures, row.key));
  // Shown as names of the runs or the same for all.
  std::erase_if(rows, [](const Row& row) { return row.key == "title" || row.key == "version"; });
  return rows;
}

Unit unit_of(const Row& row) {
  double most = 0;
  for (const Figure* figure : row.runs)
    if (figure && figure->value && std::isfinite(*figure->value))
      most = std::max(most, std::abs(*figure->value));
  return row.key == "wall_seconds" ? Unit{1, "s"} : readable_unit(row.unit, most);
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos)
    return text;
  std::string out = "\"";
  for (const char c : text)
    out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string csv_text(const std::vector<std::string>& names, const std::vector<Row>& rows) {
  std::vector<std::string> cells{"key", "quantity", "unit"};
  for (const std::string& name : names)
    cells.push_back(csv_cell(name));
  std::string text = fmt::format("{}\n", fmt::join(cells, ","));
  for (const Row& row : rows) {
    cells = {csv_cell(row.key), csv_cell(row.label), csv_cell(row.unit)};
    for (const Figure* figure : row.runs)
      cells.push_back(figure ? csv_cell(figure->text) : "");
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return text;
}

std::string json_text(const std::vector<std::string>& names, const std::vector<fs::path>& folders,
                      const std::vector<Row>& rows) {
  json root{{"runs", json::array()}, {"rows", json::array()}};
  for (std::size_t i = 0; i < names.size(); ++i)
    root["runs"].push_back({{"name", names[i]}, {"folder", folders[i].string()}});
  for (const Row& row : rows) {
    json values = json::array();
    for (const Figure* figure : row.runs)
      values.push_back(!figure ? json() : figure->value ? json::parse(figure->text) : json(figure->text));
    root["rows"].push_back(
        {{"key", row.key}, {"quantity", row.label}, {"unit", row.unit}, {"values", values}});
  }
  return root.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

Document document_of(const Comparison& comparison) {
  Document document{"Comparison", {}};
  Table table{{""}, {}};
  table.header.insert(table.header.end(), comparison.runs.begin(), comparison.runs.end());
  for (std::size_t r = 0; r < comparison.rows.size(); ++r) {
    table.rows.push_back({comparison.rows[r]});
    table.rows.back().insert(table.rows.back().end(), comparison.values[r].begin(),
                             comparison.values[r].end());
  }
  document.blocks.push_back(std::move(table));
  for (const fs::path& file : comparison.files)
    if (file.extension() == ".png")
      document.blocks.push_back(Image{file.filename()});
  return document;
}

/// The probes all runs share, over each other.
std::vector<fs::path> draw_probes(const std::vector<fs::path>& folders, const std::vector<std::string>& names,
                                  const fs::path& output, Progress& progress) {
  std::vector<io::History> histories;
  try {
    for (const fs::path& folder : folders)
      histories.push_back(io::read_history(folder / "history.csv"));
  } catch (const Error& error) {
    progress.note(fmt::format("no picture of the probes: {}", error.what()));
    return {};
  }
  std::vector<NamedHistory> runs;
  for (std::size_t i = 0; i < names.size(); ++i)
    runs.push_back({names[i], &histories[i]});
  Plot plot{fs::absolute(output / "compare_probes.png").string(), {}};
  for (const std::string& column : probe_columns(histories.front())) {
    const bool shared = std::all_of(histories.begin(), histories.end(), [&](const io::History& history) {
      return std::count(history.names.begin(), history.names.end(), column) > 0 &&
             !history.column(column).empty();
    });
    if (shared)
      plot.charts.push_back(chart_over_time(column_quantity(column).label, column, runs));
  }
  return plot.charts.empty() ? std::vector<fs::path>{} : render({{}, {plot}}, progress);
}

std::vector<fs::path> draw_fields(const std::vector<fs::path>& folders, const std::vector<std::string>& names,
                                  bool plastic, const fs::path& output, Progress& progress) {
  Picture stress;
  stress.name = "compare_von_mises";
  stress.field = "VonMises";
  stress.clip = "y";
  Picture strain = stress;
  strain.name = "compare_plastic_strain";
  strain.field = "PlasticStrain";
  return draw(plastic ? std::vector{strain, stress} : std::vector{stress}, folders, names, output, progress);
}

std::size_t width_of(const std::string& utf8) {
  return static_cast<std::size_t>(std::count_if(
      utf8.begin(), utf8.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string air(width > width_of(text) ? width - width_of(text) : 0, ' ');
  return right ? air + text : text + air;
}

} // namespace

Comparison compare(const std::vector<fs::path>& folders, const fs::path& output, Progress& progress) {
  require(!folders.empty(), "there is nothing to compare", "", "name the folders of two runs or more");
  std::vector<std::vector<Figure>> figures;
  for (const fs::path& folder : folders)
    figures.push_back(summary_figures(folder));
  io::make_output_folder(output);

  Comparison comparison;
  comparison.runs = distinct_names(folders);
  const std::vector<Row> rows = rows_of(figures);
  bool plastic = false;
  for (const Row& row : rows) {
    const Unit unit = unit_of(row);
    comparison.rows.push_back(titled(row.label, unit.name, ""));
    auto& values = comparison.values.emplace_back();
    for (const Figure* figure : row.runs) {
      values.push_back(figure ? shown(*figure, unit.factor) : "-");
      if (figure && row.key == "max.equivalent_plastic_strain" && figure->value.value_or(0) > 0)
        plastic = true;
    }
  }
  for (const auto& drawn : {draw_probes(folders, comparison.runs, output, progress),
                            draw_fields(folders, comparison.runs, plastic, output, progress)})
    comparison.files.insert(comparison.files.end(), drawn.begin(), drawn.end());
  const auto keep = [&](const char* name, const std::string& text) {
    io::write_text(output / name, text);
    comparison.files.push_back(output / name);
  };
  keep("compare.csv", csv_text(comparison.runs, rows));
  keep("compare.json", json_text(comparison.runs, folders, rows));
  const Document document = document_of(comparison);
  keep("compare.md", markdown(document));
  keep("compare.html", html(document, output));
  return comparison;
}

std::string table(const Comparison& comparison) {
  std::size_t label = 0;
  for (const std::string& row : comparison.rows)
    label = std::max(label, width_of(row));
  std::string text(label, ' ');
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    std::size_t width = width_of(comparison.runs[i]);
    for (const auto& values : comparison.values)
      width = std::max(width, width_of(values[i]));
    widths.push_back(width);
    text += "  " + padded(comparison.runs[i], width, true);
  }
  text += "\n";
  for (std::size_t r = 0; r < comparison.rows.size(); ++r) {
    text += padded(comparison.rows[r], label, false);
    for (std::size_t i = 0; i < widths.size(); ++i)
      text += "  " + padded(comparison.values[r][i], widths[i], true);
    text += "\n";
  }
  return text;
}

} // namespace tessera::post

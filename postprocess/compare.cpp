#include "postprocess/compare.hpp"

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/history.hpp"
#include "postprocess/csv.hpp"
#include "postprocess/document.hpp"
#include "postprocess/field_difference.hpp"
#include "postprocess/history_charts.hpp"
#include "postprocess/picture.hpp"
#include "postprocess/quantity.hpp"
#include "postprocess/render_job.hpp"
#include "postprocess/run_figures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

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
  return row.key.ends_with("_seconds") ? Unit{1, "s"} : readable_unit(row.unit, most);
}

std::string csv_text(const std::vector<std::string>& names, const std::vector<Row>& rows) {
  std::vector<std::string> cells{"key", "quantity", "unit"};
  cells.insert(cells.end(), names.begin(), names.end());
  std::string text = csv_line(cells);
  for (const Row& row : rows) {
    cells = {row.key, row.label, row.unit};
    for (const Figure* figure : row.runs)
      cells.push_back(figure ? figure->text : "");
    text += csv_line(cells);
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

/// Columns of all runs' histories over each other: probes, forces, and those asked for, each with its file.
std::vector<fs::path> draw_histories(const std::vector<fs::path>& folders,
                                     const std::vector<std::string>& names,
                                     const std::vector<std::string>& asked, const fs::path& output,
                                     Progress& progress) {
  std::vector<io::History> histories;
  try {
    for (const fs::path& folder : folders)
      histories.push_back(io::read_history(folder / "history.csv"));
  } catch (const Error& error) {
    if (!asked.empty())
      throw;
    progress.note(fmt::format("no curves over time: {}", error.what()));
    return {};
  }
  std::vector<NamedHistory> runs;
  for (std::size_t i = 0; i < names.size(); ++i)
    runs.push_back({names[i], &histories[i]});
  const auto shared = [&](const std::string& column) {
    return std::all_of(histories.begin(), histories.end(), [&](const io::History& history) {
      return std::count(history.names.begin(), history.names.end(), column) > 0 &&
             !history.column(column).empty();
    });
  };
  const auto moves = [&](const io::History& history, const std::string& column) {
    const std::vector<double>& values = history.column(column);
    return std::any_of(values.begin(), values.end(), [](double value) { return value != 0; });
  };
  RenderJob job;
  const auto draw = [&](const char* file, const std::vector<std::string>& columns) {
    Plot plot{fs::absolute(output / file).string(), {}};
    for (const std::string& column : columns)
      plot.charts.push_back(chart_over_time(column_quantity(column).label, column, runs));
    if (!plot.charts.empty())
      job.plots.push_back(std::move(plot));
  };
  const auto telling = [&](std::vector<std::string> columns) {
    std::erase_if(columns, [&](const std::string& column) {
      return !shared(column) || std::none_of(histories.begin(), histories.end(),
                                             [&](const auto& history) { return moves(history, column); });
    });
    return columns;
  };
  const std::vector<std::string> probes = probe_columns(histories.front());
  if (!probes.empty() && std::none_of(probes.begin(), probes.end(), shared))
    progress.note(fmt::format("no curves of probes: the runs share none of {}", fmt::join(probes, ", ")));
  draw("compare_probes.png", telling(probes));
  draw("compare_forces.png", telling(force_columns(histories.front())));
  draw("compare_history.png", asked); // a column that is not there is refused by its reader
  return render(job, progress);
}

/// "PlasticStrain" becomes plastic_strain, "Stress.xy" stress_xy: for names of files.
std::string file_word(const std::string& field) {
  std::string word;
  for (std::size_t i = 0; i < field.size(); ++i) {
    const auto c = static_cast<unsigned char>(field[i]);
    if (std::isupper(c) && i > 0 && std::islower(static_cast<unsigned char>(field[i - 1])))
      word += '_';
    word += std::isalnum(c) ? static_cast<char>(std::tolower(c)) : '_';
  }
  return word;
}

std::vector<fs::path> draw_fields(const std::vector<fs::path>& folders, const std::vector<std::string>& names,
                                  const std::vector<std::string>& fields, const Sight& sight,
                                  const fs::path& output, Progress& progress) {
  std::vector<Picture> pictures;
  for (const std::string& field : fields) {
    Picture& picture = pictures.emplace_back();
    picture.name = "compare_" + file_word(field);
    picture.field = field;
    picture.view = sight.view;
    picture.clip = sight.clip;
    picture.frame = sight.time;
    picture.times = sight.times;
    picture.skin = sight.skin;
    picture.outline = sight.outline;
    picture.magnify = sight.magnify;
  }
  return draw(pictures, folders, names, output, progress);
}

/// The runs at the moment in question; none, with a note, where one has no frames and `needed` is not set.
std::vector<Snapshot> snapshots_of(const std::vector<fs::path>& folders, const std::string& time, bool needed,
                                   Progress& progress) {
  std::vector<Snapshot> snapshots;
  try {
    for (const fs::path& folder : folders)
      snapshots.push_back(read_snapshot(folder, time));
  } catch (const InputError& error) {
    if (needed)
      throw;
    progress.note(fmt::format("fields are not compared: {}", error.what()));
    return {};
  }
  double first = snapshots.front().frame.time, last = first;
  double asked = 0;
  const bool named = std::from_chars(time.data(), time.data() + time.size(), asked).ec == std::errc();
  for (const Snapshot& snapshot : snapshots) {
    first = std::min(first, snapshot.frame.time);
    last = std::max(last, snapshot.frame.time);
  }
  const std::string at = first == last ? with_unit(first, "s")
                                       : fmt::format("{} to {}", with_unit(first, "s"), with_unit(last, "s"));
  if (named && std::max(std::abs(first - asked), std::abs(last - asked)) > 0.01 * std::abs(asked))
    progress.note(fmt::format("the frames nearest to {} are at {}", with_unit(asked, "s"), at));
  else if (last - first > 0.01 * last)
    progress.note(fmt::format("the frames compared lie apart in time: {}", at));
  return snapshots;
}

void add_differences(std::vector<std::vector<Figure>>& figures, const std::vector<Snapshot>& snapshots,
                     const std::vector<std::string>& chosen) {
  std::vector<std::string> fields{"Displacement", "PlasticStrain", "VonMises", "Pressure"};
  for (const std::string& field : chosen)
    if (std::find(fields.begin(), fields.end(), field) == fields.end())
      fields.push_back(field);
  const std::vector<Difference> differences = differences_from_first(snapshots, fields);
  for (std::size_t i = 1; i < differences.size(); ++i) {
    const auto add = [&](const std::string& key, const std::string& label, const std::string& unit,
                         double value) {
      figures[i].push_back({"difference." + key, label, unit, fmt::format("{}", value), value});
    };
    add("points", "Points of the first run inside both", "", static_cast<double>(differences[i].points));
    for (const FieldDifference& field : differences[i].fields) {
      if (!field.relative || !std::isfinite(field.largest))
        continue; // nothing there, or a run that ended in no numbers
      const Quantity quantity = field_quantity(field.field);
      const std::string key = file_word(field.field);
      add(key + ".l2_relative", quantity.label + ": difference from the first, L2 relative", "",
          *field.relative);
      add(key + ".largest", quantity.label + ": largest difference from the first", quantity.unit,
          field.largest);
    }
  }
}

/// compare_section_1.csv and .png, ...
std::vector<fs::path> draw_sections(const std::vector<SectionCurves>& sections,
                                    const std::vector<Snapshot>& snapshots,
                                    const std::vector<std::string>& names, Configuration configuration,
                                    const fs::path& output, Progress& progress) {
  RenderJob job;
  std::vector<fs::path> files;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    const SectionCurves& section = sections[k];
    const fs::path stem = output / fmt::format("compare_section_{}", k + 1);
    files.push_back(fs::path(stem) += ".csv");
    io::write_text(files.back(), csv_text(section, names));
    const Unit length = readable_unit("m", std::max(section.points.front().lpNorm<Eigen::Infinity>(),
                                                    section.points.back().lpNorm<Eigen::Infinity>()));
    const auto place = [&](const Vec3& point) {
      std::string text =
          fmt::format("{}, {}", figure(length.factor * point[0]), figure(length.factor * point[1]));
      if (snapshots.front().cloud.dimension == 3)
        text += ", " + figure(length.factor * point[2]);
      return fmt::format("({})", text);
    };
    job.plots.push_back(
        {fs::absolute(fs::path(stem) += ".png").string(),
         charts_of(section, names,
                   fmt::format("From {} to {} {}{} at {}", place(section.points.front()),
                               place(section.points.back()), length.name,
                               configuration == Configuration::reference ? " of the body as it was," : "",
                               with_unit(snapshots.front().frame.time, "s"))),
         false});
  }
  const std::vector<fs::path> drawn = render(job, progress);
  files.insert(files.end(), drawn.begin(), drawn.end());
  return files;
}

bool is_plastic(const std::vector<Figure>& run) {
  const Figure* strain = find_figure(run, "max.equivalent_plastic_strain");
  return strain && strain->value.value_or(0) > 0;
}

/// Curves and pictures of a comparison that stood here before need not be in this one.
void remove_earlier(const fs::path& output) {
  std::vector<fs::path> earlier;
  for (const fs::directory_entry& entry : fs::directory_iterator(output))
    if (entry.path().filename().string().starts_with("compare_"))
      earlier.push_back(entry.path());
  for (const fs::path& file : earlier)
    fs::remove(file);
}

} // namespace

Comparison compare(const std::vector<fs::path>& folders, const fs::path& output, Progress& progress,
                   const Sight& sight) {
  require(!folders.empty(), "there is nothing to compare", "", "name the folders of two runs or more");
  std::vector<std::vector<Figure>> figures;
  for (const fs::path& folder : folders)
    figures.push_back(summary_figures(folder));
  std::vector<std::string> fields = sight.fields;
  if (fields.empty()) {
    if (std::any_of(figures.begin(), figures.end(), is_plastic))
      fields.emplace_back("PlasticStrain");
    fields.emplace_back("VonMises");
  }
  const bool asked = !sight.fields.empty() || !sight.sections.empty() || sight.time != "last";
  const std::vector<Snapshot> snapshots = snapshots_of(folders, sight.time, asked, progress);
  if (!snapshots.empty())
    add_differences(figures, snapshots, sight.fields);
  std::vector<SectionCurves> sections;
  for (const Section& section : sight.sections)
    sections.push_back(cut(section, snapshots, fields, sight.configuration));
  io::make_output_folder(output);
  remove_earlier(output);

  Comparison comparison;
  comparison.runs = distinct_names(folders);
  const std::vector<Row> rows = rows_of(figures);
  for (const Row& row : rows) {
    const Unit unit = unit_of(row);
    comparison.rows.push_back(titled(row.label, unit.name, ""));
    auto& values = comparison.values.emplace_back();
    for (const Figure* figure : row.runs)
      values.push_back(figure ? shown(*figure, unit.factor) : "-");
  }
  for (const auto& drawn :
       {draw_histories(folders, comparison.runs, sight.columns, output, progress),
        draw_sections(sections, snapshots, comparison.runs, sight.configuration, output, progress),
        draw_fields(folders, comparison.runs, fields, sight, output, progress)})
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

} // namespace tessera::post

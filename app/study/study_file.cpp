#include "app/study/study_file.hpp"

#include "app/case/table.hpp"
#include "core/error.hpp"
#include "core/particle_cloud.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

namespace tessera::app {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> fields = {"displacement", "velocity", "pressure"};

std::string key_of(const std::string& assignment) {
  return assignment.substr(0, assignment.find('='));
}

/// A file named in the study, whose paths are relative to it.
fs::path beside(const fs::path& study, const std::string& file) {
  return fs::weakly_canonical(fs::absolute(study.parent_path() / file));
}

std::string label_of(Table& value) {
  const std::string label = value.text("label");
  const bool good = !label.empty() && label.size() <= 64 &&
                    std::none_of(label.begin(), label.end(),
                                 [](char c) { return std::iscntrl(static_cast<unsigned char>(c)) != 0; });
  if (value.has("label") && !good)
    value.refuse("label", fmt::format("{} is {}", value.path_of("label"), in_quotes(label)),
                 "a label has 1 to 64 characters");
  return label;
}

/// `key` and a list of its values, or a list of tables of keys under a label each.
Axis read_axis(Table table) {
  Axis axis;
  axis.name = table.name("name");
  if (table.has("key")) {
    const std::string key = table.text("key");
    const std::vector<Table::Literal> values = table.literals("values");
    table.finish();
    for (const Table::Literal& value : values)
      axis.values.push_back({value.plain, {fmt::format("{}={}", key, value.toml)}});
  } else {
    table.allow("key");
    std::vector<Table> values = table.tables("values");
    table.finish();
    if (values.empty())
      table.refuse(
          "values", fmt::format("{} lists no values", table.path()),
          "add values = [{label = \"...\", some.key = 1}, ...], or key = \"some.key\" and values = [1, 2]");
    for (Table& value : values) {
      AxisValue entry{label_of(value), {}};
      entry.assignments = value.assignments();
      value.finish();
      axis.values.push_back(std::move(entry));
    }
  }
  std::set<std::string> labels;
  for (const AxisValue& value : axis.values)
    if (!labels.insert(value.label).second)
      table.refuse("values",
                   fmt::format("axis '{}' has two values called {}", axis.name, in_quotes(value.label)),
                   "give each its own label");
  return axis;
}

std::vector<Axis> read_axes(const std::vector<Table>& tables, const Table& root) {
  if (tables.empty())
    root.refuse("axis", "the study has no axis", "add one: [[axis]] with name, key and values");
  std::vector<Axis> axes;
  std::map<std::string, std::string> set_by;
  for (const Table& table : tables) {
    Axis axis = read_axis(table);
    // Names of the columns beside the axes' own.
    for (const char* taken : {"particles", "spacing_m", "steps", "error", "cpu_seconds", "setup_seconds",
                              "peak_bytes", "spurious_energy", "verdict", "front", "run", "failure"})
      if (axis.name == taken)
        table.refuse("name", fmt::format("an axis may not be called '{}'", taken),
                     "study.csv has a column of that name");
    for (const Axis& other : axes)
      if (other.name == axis.name)
        table.refuse("name", fmt::format("two axes are called '{}'", axis.name), "give each its own name");
    for (const AxisValue& value : axis.values)
      for (const std::string& assignment : value.assignments) {
        const auto [known, fresh] = set_by.emplace(key_of(assignment), axis.name);
        if (!fresh && known->second != axis.name)
          table.refuse("values",
                       fmt::format("axes '{}' and '{}' both set {}", known->second, axis.name, known->first),
                       "let one axis set it");
      }
    axes.push_back(std::move(axis));
  }
  return axes;
}

const Axis& find_axis(const std::vector<Axis>& axes, const std::string& name, const Table& table,
                      const std::string& key) {
  std::vector<std::string> names;
  for (const Axis& axis : axes) {
    if (axis.name == name)
      return axis;
    names.push_back(axis.name);
  }
  const std::string nearest = nearest_name(name, names);
  table.refuse(key, fmt::format("the study has no axis {}", in_quotes(name)),
               fmt::format("{}axes: {}", nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest),
                           fmt::join(names, ", ")));
}

Exclusion read_exclusion(Table table, const std::vector<Axis>& axes) {
  Exclusion exclusion;
  for (const std::string& name : table.keys()) {
    const Axis& axis = find_axis(axes, name, table, name);
    std::vector<std::string> labels;
    for (const AxisValue& value : axis.values)
      labels.push_back(value.label);
    for (const Table::Literal& label : table.literals(name)) {
      if (std::find(labels.begin(), labels.end(), label.plain) == labels.end()) {
        const std::string nearest = nearest_name(label.plain, labels);
        table.refuse(name, fmt::format("axis '{}' has no value {}", name, in_quotes(label.plain)),
                     fmt::format("{}its values: {}",
                                 nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest),
                                 fmt::join(labels, ", ")));
      }
      exclusion[name].push_back(label.plain);
    }
  }
  if (exclusion.empty())
    throw InputError(fmt::format("{} names no axis", table.path()), table.where(),
                     "it would leave out every run: name axes and their labels");
  return exclusion;
}

ErrorMeasure::History read_history_reference(Table table, const fs::path& study) {
  ErrorMeasure::History history;
  history.file = beside(study, table.text("file"));
  history.column = table.text("column");
  history.time_column = table.text_or("time", "time_s");
  history.factor = table.number_or("factor", 1, positive);
  history.time_factor = table.number_or("time_factor", 1, positive);
  table.finish();
  return history;
}

std::vector<double> read_targets(Table& table) {
  if (!table.has("targets"))
    return {0.1, 0.03, 0.01, 0.003, 0.001};
  std::vector<double> targets = table.number_list("targets");
  for (const double target : targets)
    if (target <= 0)
      table.refuse("targets", fmt::format("a target is {}", target),
                   "it is a relative error, greater than 0");
  std::sort(targets.begin(), targets.end(), std::greater<>());
  return targets;
}

ErrorMeasure read_error(Table table, const fs::path& study) {
  ErrorMeasure error;
  const int ways = table.has("exact") + table.has("probe") + table.has("field");
  if (ways != 1)
    throw InputError(fmt::format("error names {} measures", ways == 0 ? "no" : "several"), table.where(),
                     "give exactly one of exact = \"velocity\", probe = \"name\" and field = \"velocity\"");
  for (const char* key : {"exact", "probe", "field", "value", "history", "finer", "norm", "targets"})
    table.allow(key);
  table.finish();
  if (table.has("exact")) {
    error.of = ErrorMeasure::Of::closed_form;
    error.name = table.choice("exact", fields);
  } else if (table.has("field")) {
    error.of = ErrorMeasure::Of::field;
    error.name = table.choice("field", fields);
  } else {
    error.of = ErrorMeasure::Of::probe;
    error.name = table.text("probe");
  }
  const std::string norm = table.choice_or("norm", "worst", {"worst", "rms", "end"});
  error.norm = norm == "worst" ? ErrorMeasure::Norm::worst
               : norm == "rms" ? ErrorMeasure::Norm::rms
                               : ErrorMeasure::Norm::end;
  error.value = table.optional_number("value");
  if (auto history = table.optional_table("history"))
    error.history = read_history_reference(*history, study);
  if (auto finer = table.optional_table("finer"))
    error.finer = finer->assignments();
  error.targets = read_targets(table);

  const auto only_for = [&](const char* key, bool serves, const char* measures) {
    if (table.has(key) && !serves)
      table.refuse(key, fmt::format("error.{} does nothing to this measure", key),
                   fmt::format("it is for {}: remove it", measures));
  };
  const bool probe = error.of == ErrorMeasure::Of::probe;
  only_for("value", probe, "probes");
  only_for("history", probe, "probes");
  only_for("finer", error.of != ErrorMeasure::Of::closed_form, "probes and fields");
  only_for("norm", probe && !error.value, "probes with a history or a finer run");
  if (const int references = error.value.has_value() + error.history.has_value() + error.finer.has_value();
      error.of != ErrorMeasure::Of::closed_form && references != 1)
    throw InputError(fmt::format("error has {} references", references), table.where(),
                     probe ? "give exactly one of value, history and [error.finer]"
                           : "add [error.finer] with the keys of the finer run");
  if (error.value && *error.value == 0)
    table.refuse("value", "error.value is 0", "errors are relative to it: choose another probe");
  return error;
}

/// A key that every value of an axis sets anew would be silently without effect.
std::vector<std::string> read_common(Table& table, const std::vector<Axis>& axes) {
  const std::vector<std::string> assignments = table.assignments();
  for (const std::string& assignment : assignments) {
    const std::string key = key_of(assignment);
    const auto sets = [&](const AxisValue& value) {
      return std::any_of(value.assignments.begin(), value.assignments.end(),
                         [&](const std::string& other) { return key_of(other) == key; });
    };
    for (const Axis& axis : axes)
      if (std::all_of(axis.values.begin(), axis.values.end(), sets))
        table.refuse(key, fmt::format("{} does nothing: every value of axis '{}' sets it", key, axis.name),
                     "leave it out of one of them");
  }
  return assignments;
}

/// Drawn where the study has the table [map], or two axes.
MapLayout read_map(std::optional<Table> table, const std::vector<Axis>& axes, double inaccurate,
                   const Table& root) {
  MapLayout map;
  map.inaccurate = inaccurate;
  map.drawn = table.has_value() || axes.size() == 2;
  if (axes.size() < 2) {
    if (table)
      root.refuse("map", "the study has one axis", "a map needs two: leave [map] out, or add an [[axis]]");
    return map;
  }
  map.rows = axes[axes.size() - 2].name;
  map.columns = axes.back().name;
  if (!table)
    return map;
  map.rows = table->text_or("rows", map.rows);
  map.columns = table->text_or("columns", map.columns);
  map.inaccurate = table->number_or("inaccurate", inaccurate, positive);
  map.unbalanced = table->number_or("unbalanced", map.unbalanced, positive);
  table->finish();
  find_axis(axes, map.rows, *table, "rows");
  find_axis(axes, map.columns, *table, "columns");
  if (map.rows == map.columns)
    table->refuse("columns", fmt::format("rows and columns of the map are both '{}'", map.rows),
                  "name two axes");
  return map;
}

} // namespace

Study read_study(const fs::path& file) {
  const Document document(file, {}, "study");
  Study study;
  study.path = document.file();
  const fs::path folder = fs::absolute(study.path).lexically_normal().parent_path();
  study.name = fmt::format("{}-{}", folder.filename().string(), study.path.stem().string());

  Table root(document);
  study.title = root.text_or("title", study.name);
  const std::string case_file = root.text("case");
  std::optional<Table> common = root.optional_table("common"), map = root.optional_table("map");
  const std::vector<Table> axes = root.tables("axis"), exclusions = root.tables("exclude");
  Table error = root.table("error");
  study.time_limit = root.number_or("time_limit", 0, not_negative);
  for (const char* key : {"colour", "marker"})
    root.allow(key);
  root.finish();

  study.case_file = beside(study.path, case_file);
  if (std::error_code failed; !fs::exists(study.case_file, failed))
    root.refuse("case", fmt::format("there is no case {}", study.case_file.string()),
                "paths are relative to the study file");
  study.axes = read_axes(axes, root);
  if (common)
    study.common = read_common(*common, study.axes);
  for (const Table& table : exclusions)
    study.exclude.push_back(read_exclusion(table, study.axes));
  study.error = read_error(error, study.path);
  if (study.error.history)
    require(fs::exists(study.error.history->file),
            fmt::format("there is no history {}", study.error.history->file.string()),
            document.where("error.history.file"), "paths are relative to the study file");
  study.colour = root.text_or("colour", study.axes.front().name);
  study.marker = root.text_or("marker", study.axes.size() > 2 ? study.axes[1].name : study.colour);
  find_axis(study.axes, study.colour, root, "colour");
  find_axis(study.axes, study.marker, root, "marker");

  study.map = read_map(std::move(map), study.axes, study.error.targets.front(), root);

  toml::table stored = document.root();
  stored.insert_or_assign("case", study.case_file.string());
  if (study.error.history)
    stored["error"]["history"].as_table()->insert_or_assign("file", study.error.history->file.string());
  std::ostringstream text;
  text << toml::toml_formatter(stored) << '\n';
  study.text = text.str();
  return study;
}

} // namespace tessera::app

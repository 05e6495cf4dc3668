/// A study file: one case, a grid over its keys, and what the runs are measured by. Read strictly and in full
/// before any run begins.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tessera::app {

/// One place on an axis: keys of the case that are set together, each "dotted.key=value".
struct AxisValue {
  std::string label;
  std::vector<std::string> assignments;
};

struct Axis {
  std::string name;
  std::vector<AxisValue> values;
};

/// By axis the labels that do not go together: a run is left out if it has one of each axis named here.
using Exclusion = std::map<std::string, std::vector<std::string>>;

/// How far a run is from what is true. All errors are relative.
struct ErrorMeasure {
  enum class Of {
    closed_form, ///< a field at the end against the case's [exact], its relative L2 norm
    probe,       ///< a probe against a number, a history or the finer run
    field        ///< a field at the end against the finer run's, sampled at that one's particles
  };
  enum class Norm { worst, rms, end }; ///< of histories: largest or root mean square difference, or the last

  Of of = Of::closed_form;
  std::string name; ///< displacement, velocity or pressure; of a probe its name in the case
  Norm norm = Norm::worst;
  std::optional<double> value; ///< what the probe should end with, SI

  struct History {
    std::filesystem::path file; ///< CSV
    std::string column, time_column;
    double factor = 1, time_factor = 1; ///< to SI units
  };
  std::optional<History> history;
  std::optional<std::vector<std::string>> finer; ///< assignments of the run the others are held against
  std::vector<double> targets;                   ///< errors to recommend a run for, descending
};

/// How map.png lays the runs out, and when it calls a run inaccurate or unstable.
struct MapLayout {
  bool drawn = false;
  std::string rows, columns; ///< names of axes; the values of the others stand in panels of their own
  double inaccurate = 0;     ///< relative error from which on a run is
  double unbalanced = 0.1;   ///< spurious share of the energy from which on a run is unstable
};

struct Study {
  std::string title;
  std::string name;           ///< of the default output folder: "swinging_cube-study"
  std::filesystem::path path; ///< of the study file
  std::filesystem::path case_file;
  std::vector<std::string> common; ///< assignments of all runs
  std::vector<Axis> axes;
  std::vector<Exclusion> exclude;
  ErrorMeasure error;
  std::string colour, marker; ///< names of the axes pareto.png tells apart
  MapLayout map;
  double time_limit = 0; ///< wall time of a run, s; 0: none
  std::string text;      ///< as TOML with absolute paths: what DIR/study.toml holds
};

/// Reads `file` (or file/study.toml where it is a folder). InputError, naming file, line and column, on
/// anything unknown, missing or contradictory.
Study read_study(const std::filesystem::path& file);

} // namespace tessera::app

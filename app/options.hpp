/// What the command line asks for.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tessera::app {

struct Options {
  std::filesystem::path case_file;            ///< run, prepare, solve, check; study: its own file
  std::vector<std::filesystem::path> folders; ///< post, export (one), compare (several)
  std::filesystem::path output;               ///< -o; empty: chosen by the command
  std::filesystem::path cloud;            ///< solve: particles stored earlier; empty: the output folder's own
  bool cells = false;                     ///< run, prepare: also write the Voronoi cells
  std::string time = "last";              ///< compare, export: which frame
  std::vector<std::string> fields;        ///< compare: what is drawn; empty: chosen by the command
  std::string view = "front", clip = "y"; ///< compare: as a picture's; "none" does not clip
  std::vector<std::string> sections;      ///< compare: "x0,y0,z0:x1,y1,z1", m
  std::vector<std::string> columns;       ///< compare: of history.csv
  std::vector<double> times;              ///< compare: columns of the pictures, s
  std::string style = "particles";        ///< compare: particles or skin
  bool outline = false;                   ///< compare: the undeformed bodies as lines
  double magnify = 1;                     ///< compare: times as large displacements are drawn
  bool reference = false;                 ///< compare: sections of the body as it was
  bool pictures = true;                   ///< run: draw and write the report
  bool explain = false;                   ///< check: also what was chosen, and why
  bool retry = false;                     ///< study: also what failed before
  std::vector<double> stretch;            ///< stability: along X, Y and Z; empty: undeformed
  bool hyperbolicity = false;             ///< materials: where their waves are real

  std::vector<std::string> overrides; ///< --set key=value, in order
  int threads = 0;                    ///< 0: all cores
  bool quiet = false;
  bool json = false;
};

} // namespace tessera::app

/// What tessera-render is asked to draw: the one contract between the library (no VTK rendering) and that
/// program.
///
/// VTK's off-screen pictures need an X server and abort the process without one, so drawing happens in a
/// child under xvfb-run, all pictures of one call in one child.
#pragma once

#include "core/progress.hpp"
#include "postprocess/tool.hpp"

#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace tessera::post {

/// One body in a drawing.
struct Panel {
  std::string file;    ///< .vtu frame or .vtp cloud
  std::string label;   ///< below it; may be empty
  double time = 0;     ///< s; NaN: not shown
  double spacing = 0;  ///< of the particles, m; 0: found from the points
  std::string clip;    ///< "", "x", "y", "z": only what is beyond a plane across that axis
  std::string cells;   ///< .vtu with the Voronoi cells to draw in place of the spheres; may be empty
  std::string body{};  ///< .vtu with the shape of the undeformed body; may be empty
  std::string cloud{}; ///< .vtp with the particles before they moved, wanted for a skin
  double clip_at = std::numeric_limits<double>::quiet_NaN(); ///< where, m; NaN: in the middle of the body
  double magnify = 1;                                        ///< times as large displacements are drawn
};

/// A body coloured by a field, panels side by side on one colour scale and one length scale.
struct Drawing {
  std::string file; ///< PNG to write
  std::string title;
  std::string field; ///< point array, or "array.component"
  std::string view = "front";
  double minimum = std::numeric_limits<double>::quiet_NaN(); ///< SI; NaN: over all panels
  double maximum = std::numeric_limits<double>::quiet_NaN();
  bool outline = false;    ///< the undeformed body as lines; a box around it where its shape is not known
  bool skin = false;       ///< as one smooth piece in place of particles, where body and cloud are known
  bool one_place = false;  ///< panels show the same part of space: moments of one run
  bool one_by_one = false; ///< panels are the frames of an animation
  int columns = 0;         ///< panels in a row; 0: all of them. Each row is a strip of one run's moments
  /// Particles before a run: values over their mean, each sphere as large as its distance to others (on a
  /// lattice half the panel's spacing), and a second line of caption that counts what is seen of a cut body.
  bool cloud = false;
  std::vector<Tool> tools{}; ///< around the body of each panel
  std::vector<Panel> panels;
};

/// One curve, points where `dots`, or columns standing on zero where `bars` (x evenly spaced).
/// Without a label it is left out of the legend, without points only there.
struct Curve {
  static constexpr int by_place = -1, grey = 7;

  std::string label;
  std::vector<double> x, y;
  bool dots = false;
  bool dashed = false;
  bool bars = false;
  int colour = by_place; ///< number of the palette's colour; curves of one chart otherwise take them in turn
  int marker = 0;        ///< of dots: circle, square, diamond, plus, cross, in turn
};

struct Chart {
  std::string title, x_title, y_title;
  bool log_x = false, log_y = false;
  std::vector<Curve> curves;
};

/// Charts above each other in one picture, or beside each other and smaller.
struct Plot {
  std::string file; ///< PNG to write
  std::vector<Chart> charts;
  bool beside = false;
};

/// Numbers over two lists of choices: coloured cells with a few words in each. Cells within the limit are
/// blue and those beyond it orange, both the stronger the further from it; what failed is dark.
struct CellChart {
  struct Cell {
    enum class Kind { blank, within, beyond, failed };
    Kind kind = Kind::blank;
    double decades = 0; ///< of the number from the limit, of either sign
    std::string words;
  };
  struct Panel {
    std::string title;
    std::vector<Cell> cells; ///< row by row from above, each from the left
  };

  std::string file; ///< PNG to write
  std::string title, row_title, column_title;
  std::vector<std::string> rows, columns;
  std::string within, beyond, failed; ///< what the three colours mean
  std::vector<Panel> panels;          ///< each of rows times columns cells
};

struct RenderJob {
  std::vector<Drawing> drawings;
  std::vector<Plot> plots;
  std::vector<CellChart> cell_charts = {};
};

/// How long drawing may take, s.
double time_limit(const RenderJob& job);

/// Draws everything and returns the files that were written. What could not be drawn, and why, is a note on
/// `progress`; only an interruption throws.
std::vector<std::filesystem::path> render(const RenderJob& job, Progress& progress);

/// As JSON text and back (InputError when the text is not a job).
std::string to_json(const RenderJob& job);
RenderJob render_job_from_json(const std::string& text);

} // namespace tessera::post

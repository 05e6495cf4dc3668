/// What the program says while it works: one rewritten line with time left on a terminal, plain lines
/// elsewhere.
#pragma once

#include <chrono>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace tessera {

class Progress {
 public:
  using Clock = std::function<double()>; ///< seconds since any fixed instant

  /// Writes to `out`; `terminal` says whether lines may be rewritten, `quiet` silences everything.
  Progress(std::ostream& out, bool terminal, bool quiet);
  Progress(std::ostream& out, bool terminal, bool quiet, Clock clock);
  ~Progress();

  /// A Progress that says nothing, for tests and for callers inside libraries.
  static Progress& silent();

  /// One plain line.
  void note(std::string_view line);

  /// Starts a piece of work of `total` units (steps, cells, seconds...) under a label.
  void begin(std::string_view label, double total);

  /// `done` of the units are done. Prints at most four times a second on a terminal, at each tenth of the
  /// work (not more often than every two seconds) elsewhere. The time left goes by the later half of the time
  /// so far: runs become slower as their steps shrink.
  void advance(double done, std::string_view detail = {});

  /// Ends the piece of work with a line that says how long it took.
  void finish(std::string_view detail = {});

 private:
  void erase_line();
  std::ostream* out_;
  bool terminal_;
  bool quiet_;
  Clock clock_;
  bool active_ = false;
  bool line_open_ = false;
  std::string label_;
  double total_ = 0;
  double start_ = 0;
  double last_print_ = 0;
  struct Mark {
    double elapsed = 0, fraction = 0;
  };
  Mark half_, mark_; ///< the first lies before half of the time that has elapsed, the second after it
  int last_tenth_ = 0;
};

/// "3 s", "4 min 10 s", "2 h 05 min": durations as people say them.
std::string duration(double seconds);

} // namespace tessera

#include "core/progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

namespace tessera {
namespace {

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace

Progress::Progress(std::ostream& out, bool terminal, bool quiet)
    : Progress(out, terminal, quiet, steady_seconds) {}

Progress::Progress(std::ostream& out, bool terminal, bool quiet, Clock clock)
    : out_(&out), terminal_(terminal), quiet_(quiet), clock_(std::move(clock)) {}

Progress::~Progress() {
  erase_line();
}

Progress& Progress::silent() {
  static std::ostream nowhere(nullptr);
  static Progress progress(nowhere, false, true);
  return progress;
}

void Progress::erase_line() {
  if (!line_open_)
    return;
  *out_ << "\r\x1b[K" << std::flush;
  line_open_ = false;
}

void Progress::note(std::string_view line) {
  if (quiet_)
    return;
  erase_line();
  *out_ << line << '\n' << std::flush;
}

void Progress::begin(std::string_view label, double total) {
  active_ = true;
  label_ = label;
  total_ = total;
  start_ = last_print_ = clock_();
  last_tenth_ = 0;
  half_ = mark_ = {};
}

void Progress::advance(double done, std::string_view detail) {
  if (quiet_ || !active_ || total_ <= 0)
    return;
  const double fraction = std::clamp(done / total_, 0.0, 1.0);
  const double now = clock_();
  const double elapsed = now - start_;
  if (elapsed >= 2 * mark_.elapsed)
    half_ = std::exchange(mark_, {elapsed, fraction});
  const int tenth = static_cast<int>(fraction * 10);
  const bool due = terminal_ ? now - last_print_ >= 0.25 : tenth > last_tenth_ && now - last_print_ >= 2.0;
  if (!due)
    return;
  last_print_ = now;
  last_tenth_ = tenth;
  const double done_since = fraction - half_.fraction;
  const std::string left =
      done_since > 0 ? duration((elapsed - half_.elapsed) * (1 - fraction) / done_since) : "unknown";
  const std::string line = fmt::format("{} {:3.0f} %, {} left{}{}", label_, 100 * fraction, left,
                                       detail.empty() ? "" : ", ", detail);
  if (terminal_) {
    *out_ << '\r' << line << "\x1b[K" << std::flush;
    line_open_ = true;
  } else {
    *out_ << line << '\n' << std::flush;
  }
}

void Progress::finish(std::string_view detail) {
  if (!active_)
    return;
  active_ = false;
  note(fmt::format("{}: done in {}{}{}", label_, duration(clock_() - start_), detail.empty() ? "" : ", ",
                   detail));
}

std::string duration(double seconds) {
  if (!std::isfinite(seconds))
    return "unknown";
  if (seconds < 9.95)
    return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 60)
    return fmt::format("{} s", whole);
  if (whole < 3600)
    return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

} // namespace tessera

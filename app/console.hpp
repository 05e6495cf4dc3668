/// Where results and progress go: text or JSON on standard output, everything else on standard error.
#pragma once

#include "app/options.hpp"
#include "core/progress.hpp"

#include <string_view>

namespace tessera::app {

class Console {
 public:
  explicit Console(const Options& options);
  Progress& progress() { return progress_; }

  /// What a command did, which its files tell too: prints `json` when machine output was asked for, else
  /// `text` (nothing when quiet). RunError when standard output cannot be written.
  void result(std::string_view text, std::string_view json) const;
  /// What a command that writes no files was asked for: as result(), when quiet too.
  void answer(std::string_view text, std::string_view json) const;

 private:
  bool quiet_, json_;
  Progress progress_;
};

} // namespace tessera::app

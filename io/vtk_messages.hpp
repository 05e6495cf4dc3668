/// VTK's own warnings and errors, kept off the terminal.
#pragma once

#include <string>

namespace tessera::io {

/// While one is alive, what VTK would print is gathered in text(). One at a time per process: VTK's output is
/// global.
class VtkMessages {
 public:
  VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;
  ~VtkMessages();

  /// All messages so far; empty when VTK was content.
  std::string text() const;
  /// The last line that says something, without VTK's source file, line and object address.
  std::string last() const;
};

} // namespace tessera::io

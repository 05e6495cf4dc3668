#include "io/vtk_messages.hpp"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <mutex>
#include <regex>
#include <sstream>

namespace tessera::io {
namespace {

class Collector : public vtkOutputWindow {
 public:
  static Collector* New();
  vtkTypeMacro(Collector, vtkOutputWindow)

      void DisplayText(const char* text) override {
    const std::lock_guard lock(mutex_);
    text_ += text;
  }
  std::string text() const {
    const std::lock_guard lock(mutex_);
    return text_;
  }
  void clear() { text_.clear(); }

 private:
  mutable std::mutex mutex_;
  std::string text_;
};
vtkStandardNewMacro(Collector);

Collector& collector() {
  static const auto instance = vtkSmartPointer<Collector>::New();
  return *instance;
}

} // namespace

VtkMessages::VtkMessages() {
  collector().clear();
  vtkOutputWindow::SetInstance(&collector());
  // Errors also go to VTK's logger, which would print them on its own.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}

VtkMessages::~VtkMessages() {
  vtkOutputWindow::SetInstance(nullptr);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_INFO);
}

std::string VtkMessages::text() const {
  return collector().text();
}

std::string VtkMessages::last() const {
  static const std::regex origin(R"(^\s*(ERROR|Warning|Generic Warning): In .*$)");
  static const std::regex object(R"(^\s*\w+ \(0x[0-9a-fA-F]+\):\s*)");
  std::istringstream lines(text());
  std::string line, kept;
  while (std::getline(lines, line)) {
    if (line.find_first_not_of(" \t\r") == std::string::npos || std::regex_match(line, origin))
      continue;
    kept = std::regex_replace(line, object, "");
  }
  return kept;
}

} // namespace tessera::io

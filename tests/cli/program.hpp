/// The real program, run as a user would: arguments in, exit status and both outputs back.
#pragma once

#include "core/temporary_folder.hpp"

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace tessera::cli {

struct Result {
  int status = -1; ///< exit status; 128 + number where a signal ended it
  std::string out, err;
};

/// A folder of its own, current directory of the programs a test starts, removed at the end.
class Workplace {
 public:
  const std::filesystem::path& path() const { return folder_.path(); }
  std::filesystem::path operator/(const std::string& name) const { return path() / name; }
  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  /// Names of everything below the folder, relative to it, sorted.
  std::vector<std::string> listing() const;

  /// Runs tessera here. Pictures are left out (no xvfb-run in PATH) unless `pictures`; no file may grow
  /// beyond `largest_file` bytes unless that is 0; standard output goes to `out_file` instead unless that is
  /// empty.
  struct Surroundings {
    bool pictures = false;
    std::size_t largest_file = 0;
    std::string out_file;
  };
  Result tessera(const std::vector<std::string>& arguments) const {
    return tessera(arguments, Surroundings());
  }
  Result tessera(const std::vector<std::string>& arguments, const Surroundings& surroundings) const;

  /// Starts tessera and returns at once.
  pid_t start(const std::vector<std::string>& arguments, const Surroundings& surroundings) const;
  /// Waits for it and collects what it wrote.
  Result wait(pid_t process) const;

 private:
  TemporaryFolder folder_, outputs_;
};

/// Lines of a text.
std::vector<std::string> lines(const std::string& text);

} // namespace tessera::cli

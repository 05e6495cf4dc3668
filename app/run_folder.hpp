/// The folder of a run: made before any work is done, never over somebody else's files.
#pragma once

#include "app/case/case.hpp"

#include <filesystem>

namespace tessera::app {

/// Where a case's results go unless -o says otherwise: runs/NAME in the current directory.
std::filesystem::path default_folder(const Case& the_case);

/// Creates the folder and proves that files can be written in it. InputError when they cannot, or when the
/// folder already holds files but none of ours: a study's folder is no run's, nor the other way round.
void open_folder(const std::filesystem::path& folder, bool of_study = false);

/// The folder of a run to come: opened at once, so that it is known to be writable before any work is done.
/// One that was made for it and is still empty in the end (the input was refused) goes again.
class RunFolder {
 public:
  explicit RunFolder(std::filesystem::path folder);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  bool existed_;
};

/// Stores the case with its overrides, so that the folder alone is enough to repeat or redraw the run.
void store_case(const Case& the_case, const std::vector<std::string>& overrides,
                const std::filesystem::path& folder);

/// Writes `text` under a line that says which version wrote it from which file with which overrides, and by
/// which the folder is known as ours.
void store_input(const std::filesystem::path& to, const std::filesystem::path& from,
                 const std::vector<std::string>& overrides, const std::string& text);

/// Removes what an earlier run left: its results do not belong to what is computed next.
void remove_solution(const std::filesystem::path& folder);
/// The same with the particles.
void remove_all_results(const std::filesystem::path& folder);

/// Whether the folder's cloud.vtp was made from this case's geometry, particles and sets, and after the CAD
/// file was last changed.
bool holds_cloud_of(const std::filesystem::path& folder, const Case& the_case);

} // namespace tessera::app

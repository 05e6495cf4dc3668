/// Figures of a finished run, from its summary.json.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace tessera::app {

class StoredSummary {
 public:
  /// InputError when the folder holds no summary.json that can be read.
  explicit StoredSummary(const std::filesystem::path& folder);
  ~StoredSummary();

  /// The number at a JSON pointer such as "/error/l2_velocity_relative"; NaN where there is none.
  double number(const std::string& pointer) const;

 private:
  struct Content;
  std::unique_ptr<Content> content_;
};

} // namespace tessera::app

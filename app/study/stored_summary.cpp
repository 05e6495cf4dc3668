#include "app/study/stored_summary.hpp"

#include "core/error.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <limits>

namespace tessera::app {

struct StoredSummary::Content {
  nlohmann::json json;
};

StoredSummary::StoredSummary(const std::filesystem::path& folder) : content_(std::make_unique<Content>()) {
  std::ifstream in(folder / "summary.json");
  content_->json = nlohmann::json::parse(in, nullptr, false);
  require(content_->json.is_object(), "the summary is damaged", (folder / "summary.json").string(),
          "remove the folder and run again");
}

StoredSummary::~StoredSummary() = default;

double StoredSummary::number(const std::string& pointer) const {
  const nlohmann::json::json_pointer place(pointer);
  const nlohmann::json& json = content_->json;
  return json.contains(place) && json.at(place).is_number() ? json.at(place).get<double>()
                                                            : std::numeric_limits<double>::quiet_NaN();
}

} // namespace tessera::app

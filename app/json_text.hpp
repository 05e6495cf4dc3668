/// What the program's JSON results have in common.
#pragma once

#include "core/tensor.hpp"
#include "solver/scene/scene.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace tessera::app {

using Json = nlohmann::ordered_json;

inline Json list(const Vec3& x) {
  return Json::array({x[0], x[1], x[2]});
}

inline Json step_json(const solver::StepChoice& step) {
  return {{"by_wave", step.by_wave}, {"critical", step.critical}, {"bound", step.bound}};
}

/// Names come from files and may not be UTF-8; a result must not be lost over one.
inline std::string print(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace tessera::app

#pragma once
/// What a valve's model says of itself, as text: its age, what references moved it to, how fast it drifts.
#include <string>

#include "addons/live/engine.hpp"

namespace spoolflow::live {

/// JSON of /api/v1/valves/ID/model.
[[nodiscard]] std::string model_json(const Engine& engine, std::size_t valve);

}  // namespace spoolflow::live

#pragma once
/// What the valves of a site give to fieldbus and plant at this instant.
#include "addons/live/engine.hpp"
#include "addons/live/protocols/plant_answer.hpp"

namespace spoolflow::live {

/// Flow and pressure difference of a stalled valve are not known: who looks at them alone must not see what was.
[[nodiscard]] fieldbus::PlantAnswer answer_of(const Engine& engine, std::size_t valve);

}  // namespace spoolflow::live

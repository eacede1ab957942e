#include "addons/live/fieldbus/plant_answers.hpp"

#include <algorithm>
#include <cmath>

namespace spoolflow::live {

fieldbus::PlantAnswer answer_of(const Engine& engine, std::size_t valve) {
  const ValveView view = engine.valve(valve).view(false);
  fieldbus::PlantAnswer out;
  out.id = view.id;
  out.rated_flow_m3_per_s = view.rated_flow_m3_per_s;
  out.energy_J = view.energy_J;
  out.samples = view.samples;
  out.status = view.answer.status;
  out.stalled = engine.source(valve).stalled;
  const monitor::Ne107 least = out.stalled ? monitor::Ne107::function_check : monitor::Ne107::good;
  out.ne107 = static_cast<std::uint8_t>(std::max(view.condition, least));
  if (out.stalled || !std::isfinite(view.time_s)) return out;
  out.flow_m3_per_s = view.answer.flow_m3_per_s;
  out.flow_lower_m3_per_s = view.answer.flow_lower_m3_per_s;
  out.flow_upper_m3_per_s = view.answer.flow_upper_m3_per_s;
  out.pressure_difference_Pa = view.answer.pressure_difference_Pa;
  return out;
}

}  // namespace spoolflow::live

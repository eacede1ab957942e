#pragma once
/// What plant and fieldbus receive of one valve, whatever the protocol. SI units.
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "spoolflow/sensor/fieldbus/can_answer.hpp"

namespace spoolflow::fieldbus {

inline constexpr double L_per_min_per_m3_per_s = 60000, pascal_per_bar = 1e5;

struct PlantAnswer {
  std::string id{};
  double flow_m3_per_s = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not known
  double flow_lower_m3_per_s = std::numeric_limits<double>::quiet_NaN();
  double flow_upper_m3_per_s = std::numeric_limits<double>::quiet_NaN();
  double pressure_difference_Pa = std::numeric_limits<double>::quiet_NaN();
  double rated_flow_m3_per_s = 0;
  double energy_J = 0;
  std::uint64_t samples = 0;
  sensor::Status status = sensor::Status::none;
  std::uint8_t ne107 = 0;  ///< 0 good, 1 maintenance, 2 out of specification, 3 function check, 4 failure
  bool stalled = true;     ///< no samples come
};

/// What goes into CAN frames of it: the flow of a stalled valve is not known.
[[nodiscard]] inline sensor::FlowAnswer flow_answer(const PlantAnswer& from) {
  sensor::FlowAnswer out;
  out.flow_m3_per_s = static_cast<float>(from.flow_m3_per_s);
  out.flow_lower_m3_per_s = static_cast<float>(from.flow_lower_m3_per_s);
  out.flow_upper_m3_per_s = static_cast<float>(from.flow_upper_m3_per_s);
  out.full_flow_m3_per_s = static_cast<float>(from.rated_flow_m3_per_s);
  out.status = from.status;
  out.is_known = !from.stalled && std::isfinite(from.flow_m3_per_s);
  return out;
}

}  // namespace spoolflow::fieldbus

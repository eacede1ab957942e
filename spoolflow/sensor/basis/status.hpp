#pragma once
/// What the sensor says about each of its answers, faults apart from limits.
#include <array>
#include <cstdint>

namespace spoolflow::sensor {

/// Bits of a status word. A limit says that the answer is bounded by what was calibrated or by physics; a fault says
/// that an input or the model is wrong.
enum class Status : std::uint32_t {
  none = 0,
  // limits
  closed = 1U << 0,                  ///< the spool covers the metering edge: no flow but leakage
  spool_at_rest = 1U << 1,           ///< friction lies anywhere within its limits: the band is wide
  outside_force_map = 1U << 2,       ///< current or position left the magnetic-force map: answered at its edge
  outside_flow_force_map = 1U << 3,  ///< the flow force left the measured range at this position: answered at its edge
  outside_temperature = 1U << 4,     ///< the oil is colder or warmer than the calibration's recordings
  current_saturated = 1U << 5,       ///< the current sits at the end of its range
  dithered = 1U << 6,                ///< the current is dithered: friction swings between its limits
  sign_undetermined = 1U << 7,       ///< the spool is so near the centre that the flow may go either way
  ambiguous_load = 1U << 8,  ///< more flow force than the supply explains, and no port pressures are measured: a load
                             ///< may drive the oil, and the flow be larger
  flow_reversed = 1U << 9,   ///< by the port pressures a load drives the oil against the way that the spool opens
  open_stop = 1U << 10,      ///< the spool stands on its open stop: the flow force may be smaller, down to none
  // faults
  position_fault = 1U << 16,   ///< the position signal moved as no spool can: the last credible position is used; or it
                               ///< stays closed against forces that move any spool: the band is all that may flow
  sample_missing = 1U << 17,   ///< an input is missing: the last flow is held, its band opens
  other_direction = 1U << 18,  ///< the spool opens the direction of flow that the model does not know: the band is all
                               ///< that may flow there
  time_fault = 1U << 19,       ///< the time does not advance: where it runs backwards the last answer is held
  coil_fault = 1U << 20,  ///< voltage and current give a resistance that no sound coil has, or none that it carries
  temperature_fault = 1U << 21,  ///< the oil temperature reads what no oil has, or leapt: the one before is held
  current_fault = 1U << 23,      ///< the current leapt as no coil lets it: the last credible current is used
  model_doubt = 1U << 22,  ///< of no sensor: a monitor beside it has raised indicators that contradict the model, and
                           ///< has widened the band by what they say
};

inline constexpr std::uint32_t fault_bits = 0xFFFF0000U;

constexpr Status operator|(Status a, Status b) {
  return static_cast<Status>(static_cast<std::uint32_t>(a) | static_cast<std::uint32_t>(b));
}
constexpr Status& operator|=(Status& a, Status b) {
  return a = a | b;
}
constexpr bool has(Status status, Status bit) {
  return (static_cast<std::uint32_t>(status) & static_cast<std::uint32_t>(bit)) != 0;
}
constexpr Status without(Status status, Status bit) {
  return static_cast<Status>(static_cast<std::uint32_t>(status) & ~static_cast<std::uint32_t>(bit));
}
constexpr Status when(bool condition, Status bit) {
  return condition ? bit : Status::none;
}

/// Adds a bit where the condition holds.
constexpr void mark(Status& status, bool condition, Status bit) {
  if (condition) status |= bit;
}

struct StatusName {
  Status bit;
  const char* name;
};
/// The written name of each bit that sensors set, in the order in which they are listed.
inline constexpr std::array<StatusName, 18> status_names{{
    {Status::closed, "closed"},
    {Status::spool_at_rest, "spool_at_rest"},
    {Status::outside_force_map, "outside_force_map"},
    {Status::outside_flow_force_map, "outside_flow_force_map"},
    {Status::outside_temperature, "outside_temperature"},
    {Status::current_saturated, "current_saturated"},
    {Status::dithered, "dithered"},
    {Status::sign_undetermined, "sign_undetermined"},
    {Status::ambiguous_load, "ambiguous_load"},
    {Status::flow_reversed, "flow_reversed"},
    {Status::open_stop, "open_stop"},
    {Status::position_fault, "position_fault"},
    {Status::sample_missing, "sample_missing"},
    {Status::other_direction, "other_direction"},
    {Status::time_fault, "time_fault"},
    {Status::coil_fault, "coil_fault"},
    {Status::temperature_fault, "temperature_fault"},
    {Status::current_fault, "current_fault"},
}};
/// And of that which a monitor adds.
inline constexpr StatusName monitor_status_name{Status::model_doubt, "model_doubt"};

}  // namespace spoolflow::sensor

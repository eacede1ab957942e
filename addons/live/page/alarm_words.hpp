#pragma once
/// What an alarm means and what to do about it, in words for the operator of the machine.
#include <array>
#include <string_view>

namespace spoolflow::live {

struct AlarmWords {
  std::string_view cause;      ///< of an Alarm
  std::string_view meaning;    ///< a sentence
  std::string_view remedy;     ///< likewise
  std::string_view indicator;  ///< whose course shows how fast it grows; empty: none does
};

/// Every cause that an alarm can have.
inline constexpr std::array<AlarmWords, 12> alarm_words{{
    {"friction", "The spool moves against more friction than when it was calibrated.",
     "Check the oil's cleanliness and the filter, and flush the valve; if the friction stays, plan to exchange it.",
     "friction_ratio"},
    {"edge_wear", "The metering edge is rounded: more oil passes near the closed end than calibrated.",
     "Check the oil's cleanliness; plan to exchange the spool, or calibrate the valve again if its flow is still "
     "enough.",
     "edge_rounding"},
    {"spring", "The spring pushes with less force than calibrated.",
     "Check the spring and its adjusting screw; exchange the spring or calibrate the valve again.",
     "spring_preload_ratio"},
    {"coil", "The solenoid has turns that are shorted, or more resistance than a warm winding has.",
     "Measure the coil's resistance at its plug; check plug and cable, then exchange the solenoid.", "shorted_turns"},
    {"position_sensor", "The position sensor reads zero at another place than when it was calibrated.",
     "Adjust the zero of the position sensor with the coils silent; check its fastening.", "position_zero"},
    {"temperature_sensor", "The oil temperature is not plausible; flow rates are computed with the last plausible one.",
     "Check the temperature sensor and its cable.", ""},
    {"wrong_model", "The forces of this valve fit neither its model nor any known wear.",
     "Check that this is the valve, and the coil, that the model was made of; calibrate it again.", ""},
    {"no_samples", "No samples arrive: the figures shown are the last ones.",
     "Check the valve's electronics, the network and the sender.", ""},
    {"maintenance_required", "The valve differs from its model and no single cause explains it.",
     "Look at the raised indicators and at the raw samples around the alarm.", ""},
    {"out_of_specification", "The valve works outside the range that it was calibrated for; the band may not hold.",
     "Compare current, pressure and temperature with the calibrated ranges; calibrate over the range that is used.",
     ""},
    {"function_check", "Samples or times are missing: there is no answer for a while.",
     "Check the measuring channels and the sender's clock.", ""},
    {"failure", "An input or the coil has failed.",
     "Check coil, position sensor and their cables; the status names the channel.", ""},
}};

/// Of NE 107 F: the status states it, and no course of an indicator does.
inline constexpr AlarmWords failed_position_sensor{
    "position_sensor", "The position signal jumps as no spool can, or stands still while the current moves.",
    "Check cable, connector and demodulator of the position sensor.", ""};

/// Of an alarm's cause and sign. Null where the cause is none of them.
[[nodiscard]] constexpr const AlarmWords* words_for(std::string_view cause, std::string_view sign) {
  if (cause == failed_position_sensor.cause && sign == "F") return &failed_position_sensor;
  for (const AlarmWords& each : alarm_words) {
    if (each.cause == cause) return &each;
  }
  return nullptr;
}

}  // namespace spoolflow::live

#pragma once
/// Whether bytes from elsewhere can be a running sensor's state at all: a checksum can be forged.
#include <cmath>
#include <cstring>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/export/state_bytes.hpp"

namespace spoolflow::exports {

/// One direction's position track: nothing in it leads outside its rings.
inline bool may_be_track(const sensor::PositionState<double>& state) {
  unsigned char motion = 0;
  std::memcpy(&motion, &state.motion, 1);
  constexpr int most_samples = 1 << 20;
  const auto counts = [](int count, int most) { return count >= 0 && count <= most; };
  return is_bool(state.velocity_due) && is_bool(state.lone) &&
         motion <= static_cast<unsigned char>(sensor::Motion::closing) &&
         counts(state.newest, sensor::position_blocks - 1) && counts(state.blocks, sensor::position_blocks) &&
         counts(state.samples, most_samples);
}

/// An answer that may be held: numbers, the flow inside its band.
inline bool may_be_answer(const sensor::Estimate<double>& answer) {
  for (const double number :
       {answer.pressure_difference_Pa, answer.magnetic_force_N, answer.spring_force_N, answer.flow_force_N,
        answer.friction_force_N, answer.flow_lower_m3_per_s, answer.flow_upper_m3_per_s})
    if (!std::isfinite(number)) return false;
  return answer.flow_lower_m3_per_s <= answer.flow_m3_per_s && answer.flow_m3_per_s <= answer.flow_upper_m3_per_s;
}

inline bool may_be_coil(const sensor::CoilResistanceState<double>& state) {
  return is_bool(state.implausible) && is_bool(state.unanswered);
}

inline bool may_be_observer(const sensor::ObserverState<double>& state) {
  return is_bool(state.started) && is_bool(state.swing.frees) && may_be_coil(state.actuator.coil_resistance) &&
         may_be_track(state.position) && may_be_answer(state.last);
}

/// `bytes`: sizeof(RunningState) of them.
inline bool may_be_running_state(const void* bytes) {
  estimation::RunningState state;
  std::memcpy(&state, bytes, sizeof state);
  return may_be_answer(state.condensed.last) && may_be_answer(state.whole_condensed.last) &&
         may_be_observer(state.observer) && may_be_observer(state.whole_valve.open) &&
         may_be_coil(state.whole_valve.idle.actuator.coil_resistance) && is_bool(state.whole_valve.opens_a) &&
         is_bool(state.times.started) && is_bool(state.times.answered);
}

}  // namespace spoolflow::exports

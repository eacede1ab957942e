#pragma once
/// Whether bytes from elsewhere can be a running sensor's state at all: a checksum can be forged.
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
  return is_bool(state.velocity_due) && motion <= static_cast<unsigned char>(sensor::Motion::closing) &&
         counts(state.newest, sensor::position_blocks - 1) && counts(state.blocks, sensor::position_blocks) &&
         counts(state.samples, most_samples);
}

inline bool may_be_observer(const sensor::ObserverState<double>& state) {
  return is_bool(state.started) && is_bool(state.swing.frees) && is_bool(state.actuator.coil_resistance.implausible) &&
         may_be_track(state.position);
}

/// `bytes`: sizeof(RunningState) of them.
inline bool may_be_running_state(const void* bytes) {
  estimation::RunningState state;
  std::memcpy(&state, bytes, sizeof state);
  return may_be_observer(state.observer) && may_be_observer(state.whole_valve.open) &&
         is_bool(state.whole_valve.idle.actuator.coil_resistance.implausible) && is_bool(state.whole_valve.opens_a) &&
         is_bool(state.times.started) && is_bool(state.times.answered);
}

}  // namespace spoolflow::exports

#pragma once
/// Whether bytes from elsewhere can be a running sensor's state: a checksum can be forged, and a disk can lie. One
/// check for the C interface, the FMU and every store that keeps states.
#include <cmath>
#include <cstring>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/numerics/number_check.hpp"

namespace spoolflow::estimation {

using numerics::holds_numbers;

/// One direction's position track: nothing in it leads outside its rings.
inline bool may_be_track(const sensor::PositionState<double>& state) {
  unsigned char motion = 0;
  std::memcpy(&motion, &state.motion, 1);
  constexpr int most_samples = 1 << 20;
  const auto counts = [](int count, int most) { return count >= 0 && count <= most; };
  return motion <= static_cast<unsigned char>(sensor::Motion::closing) &&
         counts(state.newest, sensor::position_blocks - 1) && counts(state.blocks, sensor::position_blocks) &&
         counts(state.samples, most_samples);
}

/// An answer that may be held: the flow inside its band, which is finite.
inline bool may_be_answer(const sensor::Estimate<double>& answer) {
  return RunningSensor::is_ordered(answer) && holds_numbers(answer);
}

inline bool may_be_held(int samples) {
  return samples >= 0 && samples <= sensor::most_held_currents;
}

/// A voltage that is not measured is no number, and neither is that of a sample whose current was replaced: every
/// sample writes the one, and nothing reads the other before the next such sample writes it.
inline bool may_be_observer(sensor::ObserverState<double> state) {
  if (!std::isfinite(state.position.coil.voltage_V)) state.position.coil.voltage_V = 0;
  state.held = {};
  return may_be_held(state.held_currents) && may_be_track(state.position) && may_be_answer(state.last) &&
         holds_numbers(state);
}

/// `bytes`: sizeof(RunningState) of them. What it lets through leads to finite answers inside ordered bands
/// (RunningSensor::complete starts again where not).
[[nodiscard]] inline bool may_be_running_state(const void* bytes) {
  RunningState state;
  std::memcpy(&state, bytes, sizeof state);
  sensor::WholeValveState<double> whole_valve = state.whole_valve;
  whole_valve.open = {};
  return may_be_answer(state.condensed.last) && may_be_answer(state.whole_condensed.last) &&
         may_be_observer(state.observer) && may_be_observer(state.whole_valve.open) &&
         may_be_held(whole_valve.idle.held_currents) && holds_numbers(whole_valve) && holds_numbers(state.times);
}

}  // namespace spoolflow::estimation

#pragma once
/// The sensor that is replayed: the observer, or with REPLAY_CONDENSED the condensed one.
#include <cstdint>

#include "valve_model.hpp"

using Sample = valve_model::Sample;

#ifdef REPLAY_CONDENSED
inline constexpr const auto& parameters = valve_model::condensed;
using State = valve_model::CondensedState;

/// Which way through the step was taken.
inline std::uint32_t mode_of(const State& /*state*/, const spoolflow::sensor::Estimate<float>& estimate) {
  using spoolflow::sensor::Status;
  if (has(estimate.status, Status::sample_missing)) return 0;
  if (has(estimate.status, Status::closed)) return 1;
  return has(estimate.status, Status::outside_flow_force_map) ? 3 : 2;
}
#else
inline constexpr const auto& parameters = valve_model::observer;
using State = valve_model::State;

/// Of one direction, or of the side on which a whole valve's spool stands.
template <class T>
const auto& open_side(const spoolflow::sensor::ObserverState<T>& state) {
  return state;
}
template <class WholeValve>
const auto& open_side(const WholeValve& state) {
  return state.open;
}

/// Which way through the step was taken: the spool's motion, and whether a block of positions was closed.
inline std::uint32_t mode_of(const State& state, const spoolflow::sensor::Estimate<float>& estimate) {
  if (has(estimate.status, spoolflow::sensor::Status::sample_missing)) return 0;
  const auto& position = open_side(state).position;
  return 1U + 2U * static_cast<std::uint32_t>(position.motion) + (position.samples == 0 ? 1U : 0U);
}
#endif
inline constexpr std::uint32_t modes = 9;

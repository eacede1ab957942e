#pragma once
/// The sensor that is replayed: the observer, or with REPLAY_CONDENSED the condensed one.
#include <cstdint>

#include "valve_model.hpp"

#ifdef REPLAY_CONDENSED
inline constexpr const auto& parameters = valve_model::condensed;
using State = spoolflow::sensor::CondensedState<float>;

/// Which way through the step was taken.
inline std::uint32_t mode_of(const State& /*state*/, const spoolflow::sensor::Estimate<float>& estimate) {
  using spoolflow::sensor::Status;
  if (has(estimate.status, Status::sample_missing)) return 0;
  if (has(estimate.status, Status::closed)) return 1;
  return has(estimate.status, Status::outside_flow_force_map) ? 3 : 2;
}
#else
inline constexpr const auto& parameters = valve_model::observer;
using State = spoolflow::sensor::ObserverState<float>;

/// Which way through the step was taken: the spool's motion, and whether a block of positions was closed.
inline std::uint32_t mode_of(const State& state, const spoolflow::sensor::Estimate<float>& estimate) {
  if (has(estimate.status, spoolflow::sensor::Status::sample_missing)) return 0;
  return 1U + 2U * static_cast<std::uint32_t>(state.position.motion) + (state.position.samples == 0 ? 1U : 0U);
}
#endif
inline constexpr std::uint32_t modes = 9;

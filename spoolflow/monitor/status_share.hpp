#pragma once
/// For which share of the last minutes each status was set, and the sign of NE 107 that this makes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "spoolflow/monitor/condition.hpp"
#include "spoolflow/sensor/basis/status.hpp"

namespace spoolflow::monitor {

/// One line of the table from status to NE 107: the sign is raised where the status was set for more than `share` of
/// the last `memory_s`, with that as time constant, and falls at half that share.
struct StatusRule {
  sensor::Status status;
  double memory_s;
  double share;
  Ne107 sign;
};
inline constexpr std::array<StatusRule, 9> status_rules{{
    {sensor::Status::coil_fault, 10, 0.5, Ne107::failure},
    {sensor::Status::position_fault, 60, 0.1, Ne107::failure},
    {sensor::Status::temperature_fault, 60, 0.5, Ne107::failure},
    {sensor::Status::current_fault, 60, 0.1, Ne107::failure},
    {sensor::Status::sample_missing, 10, 0.2, Ne107::function_check},
    {sensor::Status::time_fault, 10, 0.2, Ne107::function_check},
    {sensor::Status::outside_force_map, 600, 0.5, Ne107::out_of_specification},
    {sensor::Status::outside_flow_force_map, 600, 0.5, Ne107::out_of_specification},
    {sensor::Status::outside_temperature, 600, 0.5, Ne107::out_of_specification},
}};

/// Where the table has a status; behind its end: nowhere.
constexpr std::size_t rule_of(sensor::Status status) {
  std::size_t k = 0;
  while (k < status_rules.size() && status_rules[k].status != status) ++k;
  return k;
}

struct StatusShares {
  std::array<double, status_rules.size()> share{};
  std::array<bool, status_rules.size()> raised{};
};
static_assert(std::is_trivially_copyable_v<StatusShares>);

/// A share that has fallen below this is forgotten: further it would become denormal, which takes long to compute with.
inline constexpr double forgotten_share = 1e-9;

/// One answer; `time_step_s` >= 0 and finite.
inline void follow_status(StatusShares& state, sensor::Status status, double time_step_s) {
  for (std::size_t k = 0; k < status_rules.size(); ++k) {
    const StatusRule& rule = status_rules[k];
    const bool set = sensor::has(status, rule.status);
    double& share = state.share[k];
    if (!set && share == 0) continue;  // as nearly always
    share += std::min(time_step_s / rule.memory_s, 1.0) * ((set ? 1.0 : 0.0) - share);
    if (share < forgotten_share) share = 0;
    state.raised[k] = share > (state.raised[k] ? 0.5 : 1.0) * rule.share;
  }
}

/// Of a status in the table, over `watched_s` since nothing was known: the share of the time in which it was set, what
/// is longer ago than its memory counting less.
inline double mean_share(const StatusShares& state, sensor::Status status, double watched_s) {
  const std::size_t k = rule_of(status);
  return watched_s > 0 ? state.share[k] / -std::expm1(-watched_s / status_rules[k].memory_s) : 0;
}

/// The worst sign of those that are raised.
inline Ne107 sign_of(const StatusShares& state) {
  Ne107 worst = Ne107::good;
  for (std::size_t k = 0; k < status_rules.size(); ++k) {
    if (state.raised[k] && status_rules[k].sign > worst) worst = status_rules[k].sign;
  }
  return worst;
}

}  // namespace spoolflow::monitor

#include "tests/findings/hunting.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "spoolflow/rig/bench/protocol.hpp"
#include "spoolflow/rig/bench/simulate.hpp"

namespace spoolflow::findings {
namespace {

double swing(const std::vector<double>& values) {
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  return *highest - *lowest;
}

/// Mean force swing of the rests from `first` to `last`, as shares of all, ordered by flow.
double mean_swing_N(const std::vector<Rest>& by_flow, double first, double last) {
  const auto at = [&](double share) {
    return by_flow.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(by_flow.size()));
  };
  const double sum = std::accumulate(at(first), at(last), 0.0,
                                     [](double so_far, const Rest& rest) { return so_far + rest.force_swing_N; });
  return sum / static_cast<double>(at(last) - at(first));
}

}  // namespace

std::vector<Rest> rests() {
  const rig::ValveUnderTest valve = rig::valve_preset("size_6");
  rig::StepsProtocol protocol{.conditions = {}, .positions_percent = {}, .rate_percent_per_s = 20, .hold_s = 15};
  for (double percent = 15; percent <= 95; percent += 5) protocol.positions_percent.push_back(percent);
  const rig::BenchRun run = plan(protocol);
  std::vector<Rest> all;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const rig::Simulation simulation = simulate(valve, run, seed, {.with_truth = true});
    const auto& time = simulation.truth["time_s"];
    const auto set = simulation.recording[recording::Channel::position_set];
    const double settling_s = 1.0;
    for (std::size_t i = 1, begin = 1; i <= set.size(); ++i) {
      if (i < set.size() && set[i] == set[begin]) continue;
      if (time[i - 1] - time[begin] > 10 && set[begin] > 0.1) {
        Rest rest{};
        const double set_um = 2400 * set[begin];
        for (std::size_t k = begin; k < i; ++k) {
          if (time[k] < time[begin] + settling_s) continue;
          rest.time_s.push_back(time[k] - time[begin]);
          rest.force_N.push_back(simulation.truth["magnetic_force_N"][k]);
          rest.position_um.push_back(1e3 * simulation.truth["position_mm"][k] - set_um);
          rest.flow_L_min += simulation.truth["flow_L_min"][k];
        }
        rest.flow_L_min /= static_cast<double>(rest.time_s.size());
        rest.force_swing_N = swing(rest.force_N);
        rest.position_swing_um = swing(rest.position_um);
        all.push_back(std::move(rest));
      }
      begin = i;
    }
  }
  return all;
}

std::vector<Finding> hunting_findings(const std::vector<Rest>& rests) {
  std::vector<Rest> by_flow = rests;
  std::sort(by_flow.begin(), by_flow.end(),
            [](const Rest& one, const Rest& two) { return one.flow_L_min < two.flow_L_min; });
  const double low_N = mean_swing_N(by_flow, 0, 1.0 / 3), high_N = mean_swing_N(by_flow, 2.0 / 3, 1);
  const auto broke_away =
      std::count_if(rests.begin(), rests.end(), [](const Rest& rest) { return rest.position_swing_um > 50; });
  return {
      {"swing of the magnetic force at rest, mean of the rests", mean_swing_N(by_flow, 0, 1), "N", 5, 60, "paper 4"},
      {"that swing at the third of largest flows over the third of smallest", high_N / low_N, "", 1.1, 3, "paper 4"},
      {"rests in which the spool breaks away",
       100 * static_cast<double>(broke_away) / static_cast<double>(rests.size()), "%", 50, 100, "paper 4"}};
}

}  // namespace spoolflow::findings

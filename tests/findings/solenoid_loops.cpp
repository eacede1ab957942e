#include "tests/findings/solenoid_loops.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/rig/bench/protocol.hpp"
#include "spoolflow/rig/bench/simulate.hpp"

namespace spoolflow::findings {
namespace {

using recording::Channel;

/// Mean force within 2 % of the stroke about mid stroke, among the samples from `begin` to `end`.
double mid_force_N(const SolenoidLoop& loop, std::size_t begin, std::size_t end, double stroke_mm) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (std::abs(loop.position_mm[i] - 0.5 * stroke_mm) > 0.02 * stroke_mm) continue;
    sum += loop.force_N[i];
    ++count;
  }
  return sum / count;
}

}  // namespace

std::vector<SolenoidLoop> solenoid_loops(double dither_percent) {
  const rig::ValveUnderTest valve = rig::valve_preset("size_6");
  const rig::SolenoidForceMapProtocol protocol{.dither_percent = dither_percent};
  const rig::BenchRun run = rig::plan(rig::Protocol(protocol), valve, 1);
  const rig::Simulation simulation = rig::simulate(valve, run, 1);
  const auto set = simulation.recording[Channel::current_set];
  const auto position = simulation.recording[Channel::position];
  const auto force = simulation.recording[Channel::force];
  std::vector<SolenoidLoop> loops;
  for (std::size_t i = 1; i < set.size(); ++i) {
    if (set[i] != set[i - 1] || set[i] < 0.05) continue;  // on the way to the next current
    if (loops.empty() || std::abs(set[i] - loops.back().current_A) > 1e-3) loops.push_back({.current_A = set[i]});
    loops.back().position_mm.push_back(1e3 * position[i]);
    loops.back().force_N.push_back(force[i]);
  }
  for (SolenoidLoop& loop : loops) {
    const auto farthest = std::max_element(loop.position_mm.begin(), loop.position_mm.end());
    const auto turn = static_cast<std::size_t>(farthest - loop.position_mm.begin());
    const double stroke_mm = 1e3 * valve.plant.spool.stroke_m;
    const double to_N = mid_force_N(loop, 0, turn, stroke_mm);
    const double fro_N = mid_force_N(loop, turn, loop.position_mm.size(), stroke_mm);
    loop.mid_force_N = 0.5 * (to_N + fro_N);
    loop.mid_width_N = std::abs(fro_N - to_N);
  }
  return loops;
}

std::vector<Finding> solenoid_findings(const std::vector<SolenoidLoop>& plain,
                                       const std::vector<SolenoidLoop>& dithered) {
  // Below the springs' preload of 9 N the valve stays shut: the loops count from the current that lifts it.
  const auto lifts = [](const SolenoidLoop& loop) { return loop.mid_force_N > 9; };
  const auto first = std::find_if(plain.begin(), plain.end(), lifts);
  std::vector<Finding> findings;
  findings.push_back({fmt::format("solenoid loop at {:.1f} A, no dither", first->current_A), first->mid_width_N, "N", 1,
                      5, "paper 3"});
  findings.push_back({fmt::format("solenoid loop at {:.1f} A, no dither", plain.back().current_A),
                      plain.back().mid_width_N, "N", 1, 5, "paper 3"});
  double least_growth_N = INFINITY;
  for (auto loop = first + 1; loop != plain.end(); ++loop) {
    least_growth_N = std::min(least_growth_N, loop->mid_width_N - (loop - 1)->mid_width_N);
  }
  findings.push_back({"least growth of the loop from one current to the next", least_growth_N, "N", 0, 5, "paper 3"});
  double narrowest = INFINITY, widest = 0;
  for (const SolenoidLoop& loop : dithered) {
    if (!lifts(loop)) continue;
    narrowest = std::min(narrowest, 100 * loop.mid_width_N / loop.mid_force_N);
    widest = std::max(widest, 100 * loop.mid_width_N / loop.mid_force_N);
  }
  findings.push_back({"narrowest loop with dither, of the force", narrowest, "%", 2, 10, "paper 2.2"});
  findings.push_back({"widest loop with dither, of the force", widest, "%", 2, 10, "paper 2.2"});
  const SolenoidLoop& top = plain.back();
  const auto force_at = [&](double position_mm) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < top.force_N.size(); ++i) {
      if (std::abs(top.position_mm[i] - position_mm) < 0.05) sum += top.force_N[i], ++count;
    }
    return sum / count;
  };
  findings.push_back({"growth of the force with the air gap at the largest current, over the stroke",
                      100 * (force_at(0.1) / force_at(2.3) - 1), "%", 2, 40, "paper 3"});
  return findings;
}

}  // namespace spoolflow::findings

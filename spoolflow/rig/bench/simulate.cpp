#include "spoolflow/rig/bench/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "spoolflow/rig/bench/running_bench.hpp"
#include "spoolflow/rig/plants/plant_group.hpp"

namespace spoolflow::rig {

Simulation simulate(const ValveUnderTest& valve, const BenchRun& run, std::uint64_t seed,
                    const SimulationOptions& options) {
  RunningBench bench(valve, run, seed);
  GroundTruth truth(run.whole_valve);  // the truth first: see read_scenario
  Simulation out{.recording = {}, .truth = std::move(truth)};
  const std::int64_t end = std::llround(run.duration_s() / electronics_period_s);
  const std::int64_t ticks_per_report = std::max<std::int64_t>(1, end / 200);
  for (std::int64_t tick = 0; tick < end; ++tick) {
    const bool samples = bench.tick(out.recording, options);
    if (samples && options.with_truth) out.truth.add(bench.truth());
    if (options.progress && tick % ticks_per_report == 0) {
      options.progress(static_cast<double>(tick) / static_cast<double>(end));
    }
  }
  return out;
}

namespace {

/// Benches whose plants are stepped together.
class BenchesAtOnce {
 public:
  BenchesAtOnce(std::span<const ValveUnderTest> valves, std::span<const BenchRun> runs,
                std::span<const std::uint64_t> seeds) {
    for (std::size_t k = 0; k < valves.size(); ++k) {
      benches_.push_back(std::make_unique<RunningBench>(valves[k], runs[k], seeds[k]));
      simulations_.push_back({.recording = {}, .truth = GroundTruth(runs[k].whole_valve)});
      ends_.push_back(std::llround(runs[k].duration_s() / electronics_period_s));
      inputs_.push_back(benches_[k]->input());
    }
    truths_.resize(valves.size());
  }

  [[nodiscard]] bool alike() const {
    return std::all_of(benches_.begin(), benches_.end(), [&](const auto& bench) {
      return rig::alike(bench->plant(), benches_[0]->plant()) &&
             bench->input().motion.has_value() == benches_[0]->input().motion.has_value();
    });
  }

  std::vector<Simulation> work(const SimulationOptions& options) {
    const SimulationOptions kept{.with_truth = options.with_truth};
    PlantGroup group = plants();
    const std::int64_t end = *std::max_element(ends_.begin(), ends_.end());
    const std::int64_t ticks_per_report = std::max<std::int64_t>(1, end / 200);
    for (std::int64_t tick = 0; tick < end; ++tick) {
      if (wants_truth(tick)) group.observe(inputs_, truths_);
      for (std::size_t k = 0; k < benches_.size(); ++k) {
        if (tick >= ends_[k]) {  // its plant rests, unseen
          const double position_m = group.state(k).position_m;
          if (inputs_[k].motion) inputs_[k].motion = PrescribedMotion{.position_m = position_m};
          inputs_[k].voltage_a_V = inputs_[k].voltage_b_V = 0;
          continue;
        }
        RunningBench& bench = *benches_[k];
        const PlantOutput* const truth = bench.wants_truth() ? &truths_[k] : nullptr;
        const bool sampled = bench.begin(truth, simulations_[k].recording, kept);
        if (sampled && kept.with_truth) simulations_[k].truth.add(bench.truth());
        inputs_[k] = bench.input();
      }
      group.step(inputs_, electronics_period_s);
      for (std::size_t k = 0; k < benches_.size(); ++k) {
        if (tick < ends_[k]) benches_[k]->end(group.state(k));
      }
      if (options.progress && tick % ticks_per_report == 0) {
        options.progress(static_cast<double>(tick) / static_cast<double>(end));
      }
    }
    return std::move(simulations_);
  }

 private:
  [[nodiscard]] PlantGroup plants() const {
    std::vector<const PlantParameters*> parameters;
    std::vector<PlantState> states;
    for (const auto& bench : benches_) {
      parameters.push_back(&bench->plant());
      states.push_back(bench->state());
    }
    return {parameters, states};
  }
  [[nodiscard]] bool wants_truth(std::int64_t tick) const {
    for (std::size_t k = 0; k < benches_.size(); ++k) {
      if (tick < ends_[k] && benches_[k]->wants_truth()) return true;
    }
    return false;
  }

  std::vector<std::unique_ptr<RunningBench>> benches_;
  std::vector<Simulation> simulations_;
  std::vector<std::int64_t> ends_;  ///< [periods]
  std::vector<PlantInput> inputs_;
  std::vector<PlantOutput> truths_;
};

}  // namespace

std::vector<Simulation> simulate_together(std::span<const ValveUnderTest> valves, std::span<const BenchRun> runs,
                                          std::span<const std::uint64_t> seeds, const SimulationOptions& options) {
  if (valves.size() > 1) {
    BenchesAtOnce benches(valves, runs, seeds);
    if (benches.alike()) return benches.work(options);
  }
  std::vector<Simulation> out;
  for (std::size_t k = 0; k < valves.size(); ++k) {
    const auto report = [&](double share) {
      options.progress((static_cast<double>(k) + share) / static_cast<double>(valves.size()));
    };
    SimulationOptions alone{.with_truth = options.with_truth};
    if (options.progress) alone.progress = report;
    out.push_back(simulate(valves[k], runs[k], seeds[k], alone));
  }
  return out;
}

}  // namespace spoolflow::rig

/// Sensors over many valves: one after the other, and together in SIMD registers, in one run.
/// valve_batch MODEL.json RECORDING
#include "spoolflow/estimation/batch/valve_batch.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/export/number_groups.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/validation/sensor_channels.hpp"

namespace {

using namespace spoolflow;
constexpr std::size_t samples = 8192;
constexpr int rounds = 40;

/// Nanoseconds of the fastest round so far.
template <class Work>
void time(double& fastest_ns, const Work& work) {
  const auto begun = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begun;
  fastest_ns = std::min(fastest_ns, taken.count());
}

/// What the valves measure, sample after sample, in each the valves side by side: the recording, each valve from
/// another moment on.
struct Signals {
  std::size_t valves;
  std::vector<float> time_step_s, current_A, voltage_V, position_m, oil_temperature_K, flow, pressure;

  Signals(const recording::Recording& file, std::size_t count) : valves(count) {
    using recording::Channel;
    for (std::size_t k = 0; k < samples; ++k) {
      for (std::size_t valve = 0; valve < valves; ++valve) {
        const std::size_t from = 1 + (k + valve * file.size() / valves) % (file.size() - 1);
        const auto number = [&](Channel channel) { return static_cast<float>(file[channel][from]); };
        time_step_s.push_back(static_cast<float>(file[Channel::time][from] - file[Channel::time][from - 1]));
        current_A.push_back(number(Channel::current));
        voltage_V.push_back(number(Channel::voltage));
        position_m.push_back(number(Channel::position));
        oil_temperature_K.push_back(number(Channel::oil_temperature));
      }
    }
    flow.resize(current_A.size());
    pressure.resize(current_A.size());
  }
};

template <class Parameters, class State>
void one_after_the_other(const std::vector<const Parameters*>& valves, std::vector<State>& states, Signals& on) {
  for (std::size_t valve = 0; valve < valves.size(); ++valve) {
    for (std::size_t k = valve; k < on.flow.size(); k += valves.size()) {
      const sensor::Estimate<float>& estimate =
          step(*valves[valve], states[valve],
               sensor::Sample<float>{on.time_step_s[k], on.current_A[k], on.voltage_V[k], on.position_m[k],
                                     on.oil_temperature_K[k]});
      on.flow[k] = estimate.flow_m3_per_s;
      on.pressure[k] = estimate.pressure_difference_Pa;
    }
  }
}

template <class Parameters>
void together(estimation::batch::ValveBatch<Parameters>& batch, Signals& on) {
  estimation::batch::EstimateRows estimates{};
  estimates.flow_m3_per_s = on.flow;
  estimates.pressure_difference_Pa = on.pressure;
  batch.step({on.time_step_s, on.current_A, on.voltage_V, on.position_m, on.oil_temperature_K}, estimates);
}

void read_and_write(Signals& on) {
  for (std::size_t k = 0; k < on.flow.size(); ++k) {
    on.flow[k] = on.current_A[k] + on.voltage_V[k];
    on.pressure[k] = on.position_m[k] + on.oil_temperature_K[k];
  }
}

/// All ways in turn, round after round: who else uses the machine slows them alike.
template <class State, class Parameters>
void compare(const char* estimator, const Parameters& parameters, Signals& on, bool own) {
  const std::vector<Parameters> copies(own ? on.valves : 1, parameters);
  std::vector<const Parameters*> valves;
  for (std::size_t valve = 0; valve < on.valves; ++valve) valves.push_back(&copies[own ? valve : 0]);
  std::vector<State> states(on.valves);
  const auto sets = estimation::batch::instruction_sets();
  std::vector<estimation::batch::ValveBatch<Parameters>> batches;
  for (const auto instructions : sets) batches.emplace_back(valves, instructions);
  double alone_ns = 1e15, touch_ns = 1e15;
  std::vector<double> together_ns(sets.size(), 1e15);
  for (int round = 0; round < rounds; ++round) {
    time(alone_ns, [&] { one_after_the_other(valves, states, on); });
    for (std::size_t set = 0; set < sets.size(); ++set) time(together_ns[set], [&] { together(batches[set], on); });
    time(touch_ns, [&] { read_and_write(on); });
  }
  const auto numbers = static_cast<double>(on.flow.size());
  fmt::print("{:<11}{:>6}  {:<13}{:>9.2f}", estimator, on.valves, own ? "each its own" : "one for all",
             alone_ns / numbers);
  for (const double ns : together_ns) fmt::print("{:>9.2f} ({:>2.0f} %)", ns / numbers, 100 * ns / alone_ns);
  fmt::print("{:>9.2f}\n", touch_ns / numbers);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: valve_batch MODEL.json RECORDING\n");
    return 2;
  }
  try {
    const model::Model model = model::read_model(argv[1]);
    const recording::Recording file = recording::read_recording(argv[2], validation::sensor_channels(model, {}));
    fmt::print("Nanoseconds a sample and valve, and the share of one after the other; wanted: at most 40 %.\n");
    fmt::print("{:<11}{:>6}  {:<13}{:>9}", "estimator", "valves", "models", "alone");
    for (const auto instructions : estimation::batch::instruction_sets())
      fmt::print("{:>16}", estimation::batch::name(instructions));
    fmt::print("   reading four floats and writing two\n");
    for (const std::size_t valves : {8U, 16U}) {
      Signals signals(file, valves);
      const auto condensed = exports::single_precision(sensor::laid_out(model.condensed.parameters));
      for (const bool own : {true, false}) compare<sensor::CondensedState<float>>("condensed", condensed, signals, own);
      if (!model.observer) continue;
      const auto observer = exports::single_precision(model.observer->parameters);
      for (const bool own : {true, false}) compare<sensor::ObserverState<float>>("observer", observer, signals, own);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "valve_batch: {}\n", error.what());
    return 1;
  }
  return 0;
}

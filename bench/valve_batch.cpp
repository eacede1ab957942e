/// Sensors over many valves: one after the other, and together in SIMD registers, in one run.
/// valve_batch MODEL.json RECORDING; of a model of both directions the direction b alone, and the whole valve.
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
/// another moment on. None comes to its end and begins anew, if it is long enough: a position that leaps there would be
/// doubted for seconds.
struct Signals {
  std::size_t valves;
  std::vector<float> time_step_s, current_A, voltage_V, position_m, oil_temperature_K, flow, pressure;

  Signals(const recording::Recording& file, std::size_t count) : valves(count) {
    using recording::Channel;
    const bool both = !file.has(Channel::current);
    const Channel current = both ? Channel::current_b : Channel::current;
    const Channel voltage = both ? Channel::voltage_b : Channel::voltage;
    for (std::size_t k = 0; k < samples; ++k) {
      for (std::size_t valve = 0; valve < valves; ++valve) {
        const std::size_t from = place(file, k, valve);
        const auto number = [&](Channel channel) { return static_cast<float>(file[channel][from]); };
        time_step_s.push_back(static_cast<float>(file[Channel::time][from] - file[Channel::time][from - 1]));
        current_A.push_back(number(current));
        voltage_V.push_back(number(voltage));
        position_m.push_back(number(Channel::position));
        oil_temperature_K.push_back(number(Channel::oil_temperature));
      }
    }
    flow.resize(current_A.size());
    pressure.resize(current_A.size());
  }
  [[nodiscard]] std::size_t place(const recording::Recording& file, std::size_t k, std::size_t valve) const {
    const std::size_t last = file.size() - 1;
    return 1 + (k + valve * (last > samples ? last - samples : last) / valves) % last;
  }
  [[nodiscard]] sensor::Sample<float> sample(std::size_t k) const {
    return {time_step_s[k], current_A[k], voltage_V[k], position_m[k], oil_temperature_K[k]};
  }
  [[nodiscard]] estimation::batch::SampleRows rows() const {
    return {time_step_s, current_A, voltage_V, position_m, oil_temperature_K};
  }
};

/// The same of a recording of both coils: what is above is coil b's.
struct WholeSignals : Signals {
  std::vector<float> current_a_A, voltage_a_V;

  WholeSignals(const recording::Recording& file, std::size_t count) : Signals(file, count) {
    using recording::Channel;
    for (std::size_t k = 0; k < samples; ++k) {
      for (std::size_t valve = 0; valve < valves; ++valve) {
        const std::size_t from = place(file, k, valve);
        current_a_A.push_back(static_cast<float>(file[Channel::current_a][from]));
        voltage_a_V.push_back(static_cast<float>(file[Channel::voltage_a][from]));
      }
    }
  }
  [[nodiscard]] sensor::WholeValveSample<float> sample(std::size_t k) const {
    return {time_step_s[k], current_a_A[k], current_A[k],        voltage_a_V[k],
            voltage_V[k],   position_m[k],  oil_temperature_K[k]};
  }
  [[nodiscard]] estimation::batch::WholeSampleRows rows() const {
    return {time_step_s, current_a_A, current_A, voltage_a_V, voltage_V, position_m, oil_temperature_K};
  }
};

template <class Parameters, class State, class Measured>
void one_after_the_other(const std::vector<const Parameters*>& valves, std::vector<State>& states, Measured& on) {
  for (std::size_t valve = 0; valve < valves.size(); ++valve) {
    for (std::size_t k = valve; k < on.flow.size(); k += valves.size()) {
      const sensor::Estimate<float>& estimate = step(*valves[valve], states[valve], on.sample(k));
      on.flow[k] = estimate.flow_m3_per_s;
      on.pressure[k] = estimate.pressure_difference_Pa;
    }
  }
}

template <class Parameters, class Measured>
void together(estimation::batch::ValveBatch<Parameters>& batch, Measured& on) {
  estimation::batch::EstimateRows estimates{};
  estimates.flow_m3_per_s = on.flow;
  estimates.pressure_difference_Pa = on.pressure;
  batch.step(on.rows(), estimates);
}

void read_and_write(Signals& on) {
  for (std::size_t k = 0; k < on.flow.size(); ++k) {
    on.flow[k] = on.current_A[k] + on.voltage_V[k];
    on.pressure[k] = on.position_m[k] + on.oil_temperature_K[k];
  }
}

/// All ways in turn, round after round, with new sensors each: who else uses the machine slows them alike.
template <class State, class Parameters, class Measured>
void compare(const char* estimator, const std::vector<Parameters>& models, Measured& on) {
  const bool own = models.size() > 1;
  std::vector<const Parameters*> valves;
  for (std::size_t valve = 0; valve < on.valves; ++valve) valves.push_back(&models[own ? valve : 0]);
  const auto sets = estimation::batch::instruction_sets();
  double alone_ns = 1e15, touch_ns = 1e15;
  std::vector<double> together_ns(sets.size(), 1e15);
  for (int round = 0; round < rounds; ++round) {
    std::vector<State> states(on.valves);
    time(alone_ns, [&] { one_after_the_other(valves, states, on); });
    for (std::size_t set = 0; set < sets.size(); ++set) {
      estimation::batch::ValveBatch<Parameters> batch(valves, sets[set]);
      time(together_ns[set], [&] { together(batch, on); });
    }
    time(touch_ns, [&] { read_and_write(on); });
  }
  const auto numbers = static_cast<double>(on.flow.size());
  fmt::print("{:<17}{:>6}  {:<13}{:>9.2f}", estimator, on.valves, own ? "each its own" : "one for all",
             alone_ns / numbers);
  for (const double ns : together_ns) fmt::print("{:>9.2f} ({:>2.0f} %)", ns / numbers, 100 * ns / alone_ns);
  fmt::print("{:>9.2f}\n", touch_ns / numbers);
}

/// Each valve's own model, and one for all.
template <class State, class Parameters>
void compare_both(const char* estimator, const Parameters& parameters, Signals& on) {
  for (const std::size_t models : {on.valves, std::size_t{1}})
    compare<State>(estimator, std::vector<Parameters>(models, parameters), on);
}

/// The same of whole valves, whose models refer to those of two directions.
template <class State, class Whole, class Parameters>
void compare_whole(const char* estimator, const Parameters& b, const Parameters& a, WholeSignals& on) {
  for (const std::size_t models : {on.valves, std::size_t{1}}) {
    const std::vector<Parameters> all_b(models, b), all_a(models, a);
    std::vector<Whole> whole;
    for (std::size_t k = 0; k < models; ++k) whole.push_back({&all_b[k], &all_a[k]});
    compare<State>(estimator, whole, on);
  }
}

void compare_whole_valves(const model::Model& model, const recording::Recording& file, std::size_t valves) {
  using exports::single_precision;
  WholeSignals on(file, valves);
  const model::Direction& a = *model.p_to_a;
  compare_whole<sensor::WholeCondensedState<float>, sensor::WholeCondensedTables<float>>(
      "whole, condensed", single_precision(sensor::laid_out(model.condensed.parameters)),
      single_precision(sensor::laid_out(a.condensed.parameters)), on);
  if (!model.observer) return;
  compare_whole<sensor::WholeValveState<float>, sensor::WholeValveParameters<float>>(
      "whole, observer", single_precision(model.observer->parameters), single_precision(a.observer->parameters), on);
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
    fmt::print("{:<17}{:>6}  {:<13}{:>9}", "estimator", "valves", "models", "alone");
    for (const auto instructions : estimation::batch::instruction_sets())
      fmt::print("{:>16}", estimation::batch::name(instructions));
    fmt::print("   reading four floats and writing two\n");
    for (const std::size_t valves : {8U, 16U}) {
      Signals signals(file, valves);
      const auto condensed = exports::single_precision(sensor::laid_out(model.condensed.parameters));
      compare_both<sensor::CondensedState<float>>("condensed", condensed, signals);
      if (model.observer) {
        compare_both<sensor::ObserverState<float>>("observer", exports::single_precision(model.observer->parameters),
                                                   signals);
      }
      if (model.whole() && file.has(recording::Channel::current_a)) compare_whole_valves(model, file, valves);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "valve_batch: {}\n", error.what());
    return 1;
  }
  return 0;
}

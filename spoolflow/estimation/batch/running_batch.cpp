#include "spoolflow/estimation/batch/running_batch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace spoolflow::estimation::batch {
namespace {

/// So many samples of all valves are brought side by side at a time.
constexpr std::size_t samples_at_once = 64;

template <class Parameters>
std::vector<const Parameters*> filled_up(std::span<const BatchedValve<Parameters>> valves) {
  std::vector<const Parameters*> out;
  for (const BatchedValve<Parameters>& valve : valves) out.push_back(valve.parameters);
  while (!out.empty() && out.size() % valves_together != 0) out.push_back(out.front());
  return out;
}

}  // namespace

template <class Parameters>
RunningBatch<Parameters>::Rows::Rows(std::size_t numbers) {
  for (std::vector<float>* row :
       {&time_step_s, &current_A, &voltage_V, &position_m, &oil_temperature_K, &current_a_A, &voltage_a_V,
        &flow_m3_per_s, &flow_lower_m3_per_s, &flow_upper_m3_per_s, &pressure_difference_Pa, &magnetic_force_N,
        &spring_force_N, &flow_force_N, &friction_force_N}) {
    row->resize(numbers, std::numeric_limits<float>::quiet_NaN());
  }
  status.resize(numbers);
  given.resize(numbers);
}

template <class Parameters>
void RunningBatch<Parameters>::Rows::put(std::size_t at, const sensor::Sample<float>& sample) {
  time_step_s[at] = sample.time_step_s;
  current_A[at] = sample.current_A;
  voltage_V[at] = sample.voltage_V;
  position_m[at] = sample.position_m;
  oil_temperature_K[at] = sample.oil_temperature_K;
}

template <class Parameters>
void RunningBatch<Parameters>::Rows::put(std::size_t at, const sensor::WholeValveSample<float>& sample) {
  put(at, sample_of(sample, false));
  current_a_A[at] = sample.current_a_A;
  voltage_a_V[at] = sample.voltage_a_V;
}

template <class Parameters>
sensor::Estimate<float> RunningBatch<Parameters>::Rows::answer(std::size_t at) const {
  return {flow_m3_per_s[at],          flow_lower_m3_per_s[at], flow_upper_m3_per_s[at],
          pressure_difference_Pa[at], magnetic_force_N[at],    spring_force_N[at],
          flow_force_N[at],           friction_force_N[at],    status[at]};
}

template <class Parameters>
RunningBatch<Parameters>::RunningBatch(std::span<const BatchedValve<Parameters>> valves, InstructionSet instructions)
    : times_(valves.size()),
      positions_(valves.size()),
      places_(filled_up(valves).size()),
      batch_(filled_up(valves), instructions),
      rows_(samples_at_once * places_) {
  for (const BatchedValve<Parameters>& valve : valves) {
    rated_flow_m3_per_s_.push_back(valve.rated_flow_m3_per_s);
    limits_.push_back(solenoid_limits(*valve.parameters));
  }
}

template <class Parameters>
void RunningBatch<Parameters>::put(std::size_t at, std::size_t valve, TimedSample sample) {
  const sensor::Status fault =
      take_out_implausible(limits_[valve], sample) | take_out_hanging(limits_[valve], positions_[valve], sample);
  SteppedSample<float>& given = rows_.given[at] = times_[valve].template next<float>(sample);
  given.fault = fault;
  if constexpr (whole) {
    if (std::isinf(sample.current_a_A)) given.sample.current_A = std::numeric_limits<float>::quiet_NaN();
    rows_.put(at, whole_valve_sample(given.sample, sample));
  } else {
    rows_.put(at, given.sample);
  }
}

/// A valve without a sample, or that only fills up, measures nothing: the sensor holds what it knows.
template <class Parameters>
void RunningBatch<Parameters>::fill(std::span<const Columns> runs, std::size_t from, std::size_t count) {
  constexpr float nothing = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t valve = 0; valve < runs.size(); ++valve) {
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t at = k * places_ + valve;
      if (from + k < runs[valve].size()) {
        put(at, valve, runs[valve][from + k]);
      } else {
        rows_.put(at, sensor::Sample<float>{nothing, nothing, nothing, nothing, nothing});
      }
    }
  }
}

template <class Parameters>
void RunningBatch<Parameters>::step(std::size_t count) {
  const std::size_t numbers = count * places_;
  const auto given = [&](const std::vector<float>& row) { return std::span<const float>(row).first(numbers); };
  const auto wanted = [&](auto& row) { return std::span(row).first(numbers); };
  const EstimateRows estimates{.flow_m3_per_s = wanted(rows_.flow_m3_per_s),
                               .flow_lower_m3_per_s = wanted(rows_.flow_lower_m3_per_s),
                               .flow_upper_m3_per_s = wanted(rows_.flow_upper_m3_per_s),
                               .pressure_difference_Pa = wanted(rows_.pressure_difference_Pa),
                               .magnetic_force_N = wanted(rows_.magnetic_force_N),
                               .spring_force_N = wanted(rows_.spring_force_N),
                               .flow_force_N = wanted(rows_.flow_force_N),
                               .friction_force_N = wanted(rows_.friction_force_N),
                               .status = wanted(rows_.status)};
  if constexpr (whole) {
    batch_.step({.time_step_s = given(rows_.time_step_s),
                 .current_a_A = given(rows_.current_a_A),
                 .current_b_A = given(rows_.current_A),
                 .voltage_a_V = given(rows_.voltage_a_V),
                 .voltage_b_V = given(rows_.voltage_V),
                 .position_m = given(rows_.position_m),
                 .oil_temperature_K = given(rows_.oil_temperature_K)},
                estimates);
  } else {
    batch_.step({.time_step_s = given(rows_.time_step_s),
                 .current_A = given(rows_.current_A),
                 .voltage_V = given(rows_.voltage_V),
                 .position_m = given(rows_.position_m),
                 .oil_temperature_K = given(rows_.oil_temperature_K)},
                estimates);
  }
}

template <class Parameters>
void RunningBatch<Parameters>::run(std::span<const Columns> runs,
                                   std::span<const std::span<sensor::Estimate<float>>> answers) {
  if (runs.size() != size() || answers.size() != size()) {
    throw std::invalid_argument("a batch of " + std::to_string(size()) + " valves got " + std::to_string(runs.size()) +
                                " runs and room for the answers of " + std::to_string(answers.size()));
  }
  std::size_t longest = 0;
  for (std::size_t valve = 0; valve < size(); ++valve) {
    longest = std::max(longest, runs[valve].size());
    if (!whole && !runs[valve].current_a_A.empty()) {
      throw std::invalid_argument("the run of valve " + std::to_string(valve) +
                                  " has the currents of both coils, and these are sensors of one direction; a batch of "
                                  "whole valves takes it (RunningBatch of WholeValveParameters)");
    }
    if (whole && !runs[valve].pressure_p_Pa.empty()) {
      throw std::invalid_argument(
          "the run of valve " + std::to_string(valve) +
          " has port pressures, which a batch does not read; leave them away, or step the valve "
          "alone");
    }
    if (answers[valve].size() == runs[valve].size()) continue;
    throw std::invalid_argument("valve " + std::to_string(valve) + " has " + std::to_string(runs[valve].size()) +
                                " samples and room for " + std::to_string(answers[valve].size()) + " answers");
  }
  for (std::size_t from = 0; from < longest; from += samples_at_once) {
    const std::size_t count = std::min(samples_at_once, longest - from);
    fill(runs, from, count);
    step(count);
    for (std::size_t valve = 0; valve < size(); ++valve) {
      for (std::size_t k = 0; k < count && from + k < runs[valve].size(); ++k) {
        sensor::Estimate<float>& answer = answers[valve][from + k] = rows_.answer(k * places_ + valve);
        times_[valve].finish(answer, rows_.given[k * places_ + valve], rated_flow_m3_per_s_[valve]);
        if (whole && !times_[valve].answered)
          answer.flow_lower_m3_per_s = -static_cast<float>(rated_flow_m3_per_s_[valve]);
      }
    }
  }
}

template class RunningBatch<sensor::CondensedTables<float>>;
template class RunningBatch<sensor::ObserverParameters<float>>;
template class RunningBatch<sensor::WholeCondensedTables<float>>;
template class RunningBatch<sensor::WholeValveParameters<float>>;

}  // namespace spoolflow::estimation::batch

#include "spoolflow/estimation/batch/valve_batch.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "spoolflow/estimation/batch/batch_steps.hpp"

namespace spoolflow::estimation::batch {
namespace {

/// The steps of one kind of valve: of the baseline, AVX2, and AVX-512 with eight and with sixteen valves.
using StepsOfSets = std::array<const BatchSteps*, 4>;

StepsOfSets all_steps(const sensor::CondensedTables<float>* /*kind*/) {
  return {&condensed_baseline, &condensed_avx2, &condensed_avx2, &condensed_avx512};
}
StepsOfSets all_steps(const sensor::ObserverParameters<float>* /*kind*/) {
  return {&observer_baseline, &observer_avx2, &observer_avx512_eight, &observer_avx512};
}
StepsOfSets all_steps(const sensor::WholeCondensedTables<float>* /*kind*/) {
  return {&whole_condensed_baseline, &whole_condensed_avx2, &whole_condensed_avx2, &whole_condensed_avx512};
}
StepsOfSets all_steps(const sensor::WholeValveParameters<float>* /*kind*/) {
  return {&whole_valve_baseline, &whole_valve_avx2, &whole_valve_avx512_eight, &whole_valve_avx512};
}

/// The widest steps that have no more valves at once than there are left, a multiple of valves_together.
const BatchSteps& widest(const StepsOfSets& steps, InstructionSet instructions, std::size_t left) {
  std::size_t set = instructions == InstructionSet::avx512 ? steps.size() - 1 : static_cast<std::size_t>(instructions);
  while (steps[set]->valves > left) --set;
  return *steps[set];
}

/// The models of a valve: of its one direction, or those of b and a.
template <class Parameters>
auto models_of(const Parameters& valve) {
  using Model = typename BatchedKind<Parameters>::Model;
  if constexpr (std::is_same_v<Model, Parameters>) {
    return std::array<const Model*, 1>{&valve};
  } else {
    return std::array<const Model*, 2>{valve.b, valve.a};
  }
}

struct NamedRow {
  const char* name;
  std::span<const float> numbers;
};

std::array<NamedRow, 5> rows_of(const SampleRows& samples) {
  return {{{"time_step_s", samples.time_step_s},
           {"current_A", samples.current_A},
           {"voltage_V", samples.voltage_V},
           {"position_m", samples.position_m},
           {"oil_temperature_K", samples.oil_temperature_K}}};
}

std::array<NamedRow, 7> rows_of(const WholeSampleRows& samples) {
  return {{{"time_step_s", samples.time_step_s},
           {"current_a_A", samples.current_a_A},
           {"current_b_A", samples.current_b_A},
           {"voltage_a_V", samples.voltage_a_V},
           {"voltage_b_V", samples.voltage_b_V},
           {"position_m", samples.position_m},
           {"oil_temperature_K", samples.oil_temperature_K}}};
}

/// So many samples of some valves are done before those of the next: what they read and write stays in the cache.
constexpr std::size_t samples_in_block = 64;

}  // namespace

std::string_view name(InstructionSet instructions) {
  constexpr std::array<std::string_view, 3> names{"baseline", "AVX2", "AVX512"};
  return names[static_cast<std::size_t>(instructions)];
}

std::vector<InstructionSet> instruction_sets() {
  std::vector<InstructionSet> out{InstructionSet::baseline};
#if defined(__x86_64__)
  if (condensed_avx2.bytes > 0 && __builtin_cpu_supports("avx2")) out.push_back(InstructionSet::avx2);
  if (out.back() == InstructionSet::avx2 && condensed_avx512.bytes > 0 && __builtin_cpu_supports("avx512f") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    out.push_back(InstructionSet::avx512);
#endif
  return out;
}

template <class Parameters>
struct ValveBatch<Parameters>::Memory {
  /// From a cache line on: no row of four numbers lies in two.
  struct alignas(64) Model {
    typename BatchedKind<Parameters>::Model parameters;
  };
  /// Valves that are stepped together.
  struct Group {
    const BatchSteps& steps;
    void* valves;
  };
  std::vector<Model> models;  ///< each once
  std::vector<Group> groups;

  Memory(std::span<const Parameters* const> valves, InstructionSet instructions) {
    std::map<const void*, std::size_t> known;
    for (const Parameters* valve : valves)
      for (const auto* model : models_of(*valve))
        if (known.try_emplace(model, models.size()).second) models.push_back({*model});
    // Places of numbers are counted in 32 bits.
    if (models.size() > std::numeric_limits<std::int32_t>::max() / (sizeof(Model) / sizeof(float))) {
      throw std::length_error("a batch of " + std::to_string(models.size()) +
                              " different models: their tables are more than one batch can reach; make several");
    }
    const StepsOfSets steps_of_sets = all_steps(static_cast<const Parameters*>(nullptr));
    for (std::size_t first = 0; first < valves.size(); first += groups.back().steps.valves) {
      const BatchSteps& steps = widest(steps_of_sets, instructions, valves.size() - first);
      std::vector<const void*> addresses;
      for (std::size_t side = 0; side < models_of(*valves.front()).size(); ++side)
        for (const Parameters* valve : valves.subspan(first, steps.valves))
          addresses.push_back(&models[known.at(models_of(*valve)[side])].parameters);
      groups.push_back({steps, ::operator new(steps.bytes, std::align_val_t(steps.alignment))});
      if (!steps.begin(groups.back().valves, addresses.data(), reinterpret_cast<const float*>(models.data()))) {
        forget();
        throw std::length_error("a batch of valves: the description of their parameters names one of them twice");
      }
    }
  }
  ~Memory() { forget(); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

 private:
  void forget() {
    for (const Group& group : groups) ::operator delete(group.valves, std::align_val_t(group.steps.alignment));
  }
};

template <class Parameters>
ValveBatch<Parameters>::ValveBatch(std::span<const Parameters* const> valves, InstructionSet instructions) {
  if (valves.empty() || valves.size() % valves_together != 0) {
    throw std::invalid_argument("a batch of " + std::to_string(valves.size()) +
                                " valves: their number must be a multiple of " + std::to_string(valves_together) +
                                "; fill up with any valve and leave its answers");
  }
  const auto known = instruction_sets();
  if (std::find(known.begin(), known.end(), instructions) == known.end())
    throw std::invalid_argument("this processor or build has no " + std::string(name(instructions)) + " instructions");
  memory_ = std::make_unique<Memory>(valves, instructions);
}

template <class Parameters>
ValveBatch<Parameters>::~ValveBatch() = default;
template <class Parameters>
ValveBatch<Parameters>::ValveBatch(ValveBatch&&) noexcept = default;
template <class Parameters>
ValveBatch<Parameters>& ValveBatch<Parameters>::operator=(ValveBatch&&) noexcept = default;

template <class Parameters>
void ValveBatch<Parameters>::step(const typename BatchedKind<Parameters>::Rows& samples,
                                  const EstimateRows& estimates) {
  std::size_t valves = 0;
  for (const auto& group : memory_->groups) valves += group.steps.valves;
  const auto rows_in = rows_of(samples);
  const char* const current = rows_in[1].name;
  const std::size_t numbers = rows_in[1].numbers.size();
  if (numbers % valves != 0)
    throw std::invalid_argument(std::to_string(numbers) + " numbers a row are no whole samples of " +
                                std::to_string(valves) + " valves");
  BatchRows all{{}, {}, 0, valves, 0};
  const auto check = [&](const char* channel, std::size_t size) {
    if (size == numbers) return;
    throw std::invalid_argument(std::string(channel) + " has " + std::to_string(size) + " numbers, but " + current +
                                " has " + std::to_string(numbers));
  };
  for (std::size_t row = 0; row < rows_in.size(); ++row) {
    check(rows_in[row].name, rows_in[row].numbers.size());
    all.samples[row] = rows_in[row].numbers.data();
  }
  const auto output = [&](std::size_t number, const char* answer, auto to) {
    if (to.empty()) return;
    check(answer, to.size());
    all.answers[all.wanted++] = {number, to.data()};
  };
  output(0, "flow_m3_per_s", estimates.flow_m3_per_s);
  output(1, "flow_lower_m3_per_s", estimates.flow_lower_m3_per_s);
  output(2, "flow_upper_m3_per_s", estimates.flow_upper_m3_per_s);
  output(3, "pressure_difference_Pa", estimates.pressure_difference_Pa);
  output(4, "magnetic_force_N", estimates.magnetic_force_N);
  output(5, "spring_force_N", estimates.spring_force_N);
  output(6, "flow_force_N", estimates.flow_force_N);
  output(7, "friction_force_N", estimates.friction_force_N);
  output(8, "status", estimates.status);

  const std::size_t count = numbers / valves;
  for (std::size_t begin = 0; begin < count; begin += samples_in_block) {
    std::size_t from = begin * valves;
    for (const auto& group : memory_->groups) {
      BatchRows rows = all;
      for (std::size_t row = 0; row < rows_in.size(); ++row) rows.samples[row] += from;
      for (std::size_t k = 0; k < rows.wanted; ++k) rows.answers[k].to = static_cast<float*>(rows.answers[k].to) + from;
      rows.count = std::min(samples_in_block, count - begin);
      group.steps.step(group.valves, rows);
      from += group.steps.valves;
    }
  }
}

template class ValveBatch<sensor::CondensedTables<float>>;
template class ValveBatch<sensor::ObserverParameters<float>>;
template class ValveBatch<sensor::WholeCondensedTables<float>>;
template class ValveBatch<sensor::WholeValveParameters<float>>;

}  // namespace spoolflow::estimation::batch

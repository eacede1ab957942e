#include "spoolflow/rig/plants/plant_group.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <stdexcept>

#include "spoolflow/rig/plants/plant_steps.hpp"

namespace spoolflow::rig {
namespace {

constexpr std::size_t most_valves_at_once = 4;

template <class Aggregate>
void append_numbers(const Aggregate& aggregate, std::vector<double>& out) {
  Aggregate::describe(aggregate, [&](const auto& what, const auto& member) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(what)>, Parameter>) {
      out.push_back(member);
    } else {
      append_numbers(member, out);
    }
  });
}

/// Of the parameters' description, valves side by side.
std::vector<double> numbers_side_by_side(std::span<const PlantParameters* const> valves) {
  std::vector<std::vector<double>> each(valves.size());
  for (std::size_t valve = 0; valve < valves.size(); ++valve) append_numbers(*valves[valve], each[valve]);
  std::vector<double> out;
  for (std::size_t k = 0; k < each.front().size(); ++k) {
    for (const std::vector<double>& numbers : each) out.push_back(numbers[k]);
  }
  return out;
}

}  // namespace

std::size_t plants_at_once() {
#if defined(__x86_64__)
  if (plant_avx2.valves > 0 && __builtin_cpu_supports("avx2") != 0) return plant_avx2.valves;
#endif
  return 1;
}

bool alike(const PlantParameters& one, const PlantParameters& other) {
  return one.arrangement == other.arrangement && one.load.kind == other.load.kind &&
         one.load.ideal_hold == other.load.ideal_hold && one.load.return_to_tank == other.load.return_to_tank &&
         one.solenoid_a.hysteresis.kind == other.solenoid_a.hysteresis.kind &&
         one.solenoid_b.hysteresis.kind == other.solenoid_b.hysteresis.kind;
}

/// As many valves as the registers hold; beyond the last valve it stands there again, and nobody asks for it.
struct PlantGroup::Memory {
  struct Free {
    std::align_val_t alignment;
    void operator()(void* memory) const { ::operator delete(memory, alignment); }
  };
  const PlantSteps* steps;   ///< null: one valve alone
  std::size_t first, count;  ///< of the group's valves
  std::unique_ptr<void, Free> lanes;
  std::vector<PlantState> spare_states;
  std::vector<PlantOutput> spare_outputs;
};

PlantGroup::PlantGroup(std::span<const PlantParameters* const> parameters, std::span<const PlantState> states)
    : parameters_(parameters.begin(), parameters.end()), states_(states.begin(), states.end()) {
  if (parameters_.size() != states_.size()) throw std::invalid_argument("a PlantGroup needs a state for each valve");
  for (const PlantParameters* const valve : parameters_) {
    if (!alike(*valve, *parameters_.front())) throw std::invalid_argument("the valves of a PlantGroup are not alike");
  }
  for (std::size_t first = 0; first < states_.size();) {
    together_.push_back(memory_of(first, states_.size() - first));
    first += together_.back().count;
  }
}

PlantGroup::Memory PlantGroup::memory_of(std::size_t first, std::size_t left) const {
  const PlantSteps* const steps = left > 1 && plants_at_once() > 1 ? &plant_avx2 : nullptr;
  if (steps == nullptr) return {nullptr, first, 1, {nullptr, {std::align_val_t{1}}}, {}, {}};
  const std::align_val_t alignment{steps->alignment};
  Memory memory{steps, first, std::min(steps->valves, left), {::operator new(steps->bytes, alignment), {alignment}},
                {},    {}};
  std::vector<const PlantParameters*> valves;
  std::vector<const PlantState*> begins;
  for (std::size_t lane = 0; lane < steps->valves; ++lane) {
    const std::size_t valve = first + std::min(lane, memory.count - 1);
    valves.push_back(parameters_[valve]);
    begins.push_back(&states_[valve]);
  }
  memory.spare_states.resize(steps->valves - memory.count);
  memory.spare_outputs.resize(steps->valves - memory.count);
  steps->begin(memory.lanes.get(), valves.data(), numbers_side_by_side(valves).data(), begins.data());
  return memory;
}

PlantGroup::PlantGroup(PlantGroup&&) noexcept = default;
PlantGroup::~PlantGroup() = default;

void PlantGroup::step(std::span<const PlantInput> inputs, double dt_s) {
  for (Memory& memory : together_) {
    if (memory.steps == nullptr) {
      rig::step(*parameters_[memory.first], states_[memory.first], inputs[memory.first], dt_s);
      continue;
    }
    std::array<const PlantInput*, most_valves_at_once> given{};
    std::array<PlantState*, most_valves_at_once> shown{};
    for (std::size_t lane = 0; lane < memory.steps->valves; ++lane) {
      given[lane] = &inputs[memory.first + std::min(lane, memory.count - 1)];
      shown[lane] = lane < memory.count ? &states_[memory.first + lane] : &memory.spare_states[lane - memory.count];
    }
    memory.steps->step(memory.lanes.get(), given.data(), dt_s);
    memory.steps->show(memory.lanes.get(), shown.data());
  }
}

void PlantGroup::observe(std::span<const PlantInput> inputs, std::span<PlantOutput> outputs) {
  for (Memory& memory : together_) {
    if (memory.steps == nullptr) {
      outputs[memory.first] = rig::observe(*parameters_[memory.first], states_[memory.first], inputs[memory.first]);
      continue;
    }
    std::array<const PlantInput*, most_valves_at_once> given{};
    std::array<PlantOutput*, most_valves_at_once> out{};
    for (std::size_t lane = 0; lane < memory.steps->valves; ++lane) {
      given[lane] = &inputs[memory.first + std::min(lane, memory.count - 1)];
      out[lane] = lane < memory.count ? &outputs[memory.first + lane] : &memory.spare_outputs[lane - memory.count];
    }
    memory.steps->observe(memory.lanes.get(), given.data(), out.data());
  }
}

}  // namespace spoolflow::rig

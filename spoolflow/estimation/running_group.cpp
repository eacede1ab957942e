#include "spoolflow/estimation/running_group.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <new>
#include <stdexcept>
#include <string>

#include "spoolflow/numerics/members.hpp"

namespace spoolflow::estimation {
namespace {

using packs::NumberKind;

/// So many samples of all valves are brought side by side at a time.
constexpr std::size_t rows_at_once = 32;
/// Fewer valves are stepped one after the other (bench/running_group).
constexpr std::size_t least_together = 3;
/// In the widest registers.
constexpr std::size_t most_valves = 8;

const packs::GroupSteps* observer_steps(GroupRegisters registers) {
  if (registers == GroupRegisters::avx512) return &packs::observer_group_avx512;
  return registers == GroupRegisters::avx2 ? &packs::observer_group_avx2 : nullptr;
}
const packs::GroupSteps* whole_valve_steps(GroupRegisters registers) {
  if (registers == GroupRegisters::avx512) return &packs::whole_valve_group_avx512;
  return registers == GroupRegisters::avx2 ? &packs::whole_valve_group_avx2 : nullptr;
}

bool has(GroupRegisters registers) {
#if defined(__x86_64__)
  if (observer_steps(registers)->valves == 0) return false;
  if (registers == GroupRegisters::avx2) return __builtin_cpu_supports("avx2") != 0;
  return __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0;
#else
  return registers == GroupRegisters::one_valve;
#endif
}

template <class Number>
constexpr NumberKind kind_of() {
  if constexpr (std::is_same_v<Number, double>) return NumberKind::number;
  if constexpr (std::is_same_v<Number, bool>) return NumberKind::truth;
  if constexpr (std::is_same_v<Number, int>) return NumberKind::whole;
  if constexpr (std::is_same_v<Number, sensor::Motion>) return NumberKind::motion;
  if constexpr (std::is_same_v<Number, sensor::Status>) return NumberKind::word;
}

/// Where the numbers of a state lie, in the order in which it has them.
template <class State>
std::span<const packs::NumberRun> runs_of_numbers() {
  static const std::vector<packs::NumberRun> runs = [] {
    std::vector<packs::NumberRun> out;
    const State state{};
    numerics::for_each_number(state, [&]<class Number>(const Number& number) {
      const auto offset =
          static_cast<std::size_t>(reinterpret_cast<const char*>(&number) - reinterpret_cast<const char*>(&state));
      const NumberKind kind = kind_of<Number>();
      if (!out.empty() && out.back().kind == kind && out.back().offset + out.back().count * sizeof number == offset) {
        ++out.back().count;
      } else {
        out.push_back({kind, offset, 1});
      }
    });
    return out;
  }();
  return runs;
}

void* state_of(RunningSensor& sensor) {
  if (sensor.runs_whole()) return &sensor.state().whole_valve;
  return &sensor.state().observer;
}

/// Of one direction, or of b and a.
std::array<const void*, 2> models_of(const RunningSensor& sensor) {
  if (const auto* whole = std::get_if<sensor::WholeValveParameters<double>>(&sensor.parameters()))
    return {whole->b, whole->a};
  return {std::get<const sensor::ObserverParameters<double>*>(sensor.parameters()), nullptr};
}

void step_alone(const GroupedRun& run, std::size_t from) {
  for (std::size_t k = from; k < run.samples.size(); ++k) run.answers[k] = run.sensor->step(run.samples[k]);
}

}  // namespace

std::string_view name(GroupRegisters registers) {
  switch (registers) {
    case GroupRegisters::avx2:
      return "AVX2";
    case GroupRegisters::avx512:
      return "AVX-512";
    case GroupRegisters::one_valve:
      break;
  }
  return "one by one";
}

std::vector<GroupRegisters> group_registers() {
  std::vector<GroupRegisters> out{GroupRegisters::one_valve};
  for (const GroupRegisters wider : {GroupRegisters::avx2, GroupRegisters::avx512})
    if (has(wider)) out.push_back(wider);
  return out;
}

void RunningGroup::Lanes::Free::operator()(void* memory) const {
  ::operator delete(memory, std::align_val_t(alignment));
}

RunningGroup::RunningGroup(GroupRegisters registers) {
  const auto known = group_registers();
  if (std::find(known.begin(), known.end(), registers) == known.end())
    throw std::invalid_argument("this processor or build has no registers of " + std::string(name(registers)));
  for (const GroupRegisters of : known) {
    if (of == GroupRegisters::one_valve || of > registers) continue;
    begin(observers_, *observer_steps(of));
    begin(whole_valves_, *whole_valve_steps(of));
  }
  observers_.state_runs = runs_of_numbers<sensor::ObserverState<double>>();
  whole_valves_.state_runs = runs_of_numbers<sensor::WholeValveState<double>>();
}

/// Where others have less than half of the room, as many fill narrower registers better.
void RunningGroup::begin(Kind& kind, const packs::GroupSteps& steps) {
  const std::size_t least = kind.lanes.empty() ? least_together : steps.valves / 2 + 1;
  kind.lanes.push_back(
      {&steps, least, {::operator new(steps.bytes, std::align_val_t(steps.alignment)), {steps.alignment}}});
  samples_.resize(std::max(samples_.size(), rows_at_once * steps.valves * steps.channels));
  answers_.resize(std::max(answers_.size(), rows_at_once * steps.valves * packs::numbers_of_an_answer));
  given_.resize(std::max(given_.size(), rows_at_once * steps.valves));
}

void RunningGroup::step(std::span<const GroupedRun> runs) {
  for (const GroupedRun& run : runs) {
    if (run.answers.size() != run.samples.size()) {
      throw std::invalid_argument("a run of " + std::to_string(run.samples.size()) + " samples has room for " +
                                  std::to_string(run.answers.size()) + " answers");
    }
  }
  for (const GroupedRun& run : runs) {
    const auto has_ports = [](const TimedSample& sample) { return measured(sample.ports); };
    const bool whole = run.sensor->runs_whole();
    if (run.sensor->runs_condensed() || (whole && std::any_of(run.samples.begin(), run.samples.end(), has_ports))) {
      step_alone(run, 0);
    } else {
      (whole ? whole_valves_ : observers_).runs.push_back(&run);
    }
  }
  for (Kind* const kind : {&observers_, &whole_valves_}) step(*kind);
}

/// Runs of about one length together: whose samples are over has nothing to do.
void RunningGroup::step(Kind& kind) {
  std::stable_sort(kind.runs.begin(), kind.runs.end(), [](const GroupedRun* one, const GroupedRun* other) {
    return one->samples.size() > other->samples.size();
  });
  const std::size_t most = kind.lanes.empty() ? 1 : kind.lanes.back().steps->valves;
  for (Runs left = kind.runs; !left.empty();) {
    const std::size_t count = std::min(left.size(), most);
    step_some(kind, left.first(count));
    left = left.subspan(count);
  }
  kind.runs.clear();
}

/// In the widest registers for which there are enough of them; as samples of some are over, in narrower ones.
void RunningGroup::step_some(Kind& kind, Runs runs) {
  std::size_t done = 0;
  for (auto lanes = kind.lanes.rbegin(); lanes != kind.lanes.rend(); ++lanes)
    if (runs.size() >= lanes->least) runs = step_together(kind, *lanes, runs, done);
  for (const GroupedRun* const run : runs) step_alone(*run, done);
}

/// The longest first. Lanes that are left over, or whose samples are over, do as the first one does. Returns the runs
/// of which samples are left when they are too few, each with its first `done` samples done.
RunningGroup::Runs RunningGroup::step_together(const Kind& kind, Lanes& lanes, Runs runs, std::size_t& done) {
  const packs::GroupSteps& steps = *lanes.steps;
  void* const memory = lanes.memory.get();
  const auto in_lane = [&](std::size_t lane) -> RunningSensor& { return *runs[lane < runs.size() ? lane : 0]->sensor; };
  std::array<const void*, 2 * most_valves> models{};
  for (std::size_t lane = 0; lane < steps.valves; ++lane) {
    const auto [b, a] = models_of(in_lane(lane));
    models[lane] = b;
    models[lane + steps.valves] = a;
  }
  if (!steps.begin(memory, models.data())) throw std::logic_error("a model has more numbers than there is room for");
  for (std::size_t lane = 0; lane < steps.valves; ++lane)
    steps.load(memory, lane, state_of(in_lane(lane)), kind.state_runs);
  while (runs.size() >= lanes.least) {
    const std::size_t until = runs.back()->samples.size();
    while (done < until) {
      const std::size_t count = std::min(rows_at_once, until - done);
      step_rows(lanes, runs, done, count);
      done += count;
    }
    for (; !runs.empty() && runs.back()->samples.size() == until; runs = runs.first(runs.size() - 1))
      steps.store(memory, runs.size() - 1, state_of(*runs.back()->sensor), kind.state_runs);
  }
  for (std::size_t lane = 0; lane < runs.size(); ++lane)
    steps.store(memory, lane, state_of(*runs[lane]->sensor), kind.state_runs);
  return runs;
}

void RunningGroup::put_sample(const packs::GroupSteps& steps, std::size_t row, std::size_t lane, const GroupedRun& run,
                              TimedSample sample) {
  SteppedSample<double>& given = given_[row * steps.valves + lane] = run.sensor->take(sample);
  double* at = samples_.data() + row * steps.channels * steps.valves + lane;
  const auto put = [&](auto... numbers) { ((*at = numbers, at += steps.valves), ...); };
  if (run.sensor->runs_whole()) {
    const auto whole = whole_valve_sample(given.sample, sample);
    put(whole.time_step_s, whole.current_a_A, whole.current_b_A, whole.voltage_a_V, whole.voltage_b_V, whole.position_m,
        whole.oil_temperature_K);
  } else {
    const auto& one = given.sample;
    put(one.time_step_s, one.current_A, one.voltage_V, one.position_m, one.oil_temperature_K);
  }
}

void RunningGroup::step_rows(const Lanes& lanes, Runs runs, std::size_t from, std::size_t count) {
  const packs::GroupSteps& steps = *lanes.steps;
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t lane = 0; lane < runs.size(); ++lane)
      put_sample(steps, row, lane, *runs[lane], runs[lane]->samples[from + row]);
    double* numbers = samples_.data() + row * steps.channels * steps.valves;
    for (std::size_t channel = 0; channel < steps.channels; ++channel, numbers += steps.valves)
      std::fill(numbers + runs.size(), numbers + steps.valves, numbers[0]);
  }
  steps.step(lanes.memory.get(), samples_.data(), answers_.data(), count);
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t lane = 0; lane < runs.size(); ++lane) {
      const double* const at = answers_.data() + row * packs::numbers_of_an_answer * steps.valves + lane;
      const auto number = [&](std::size_t k) { return at[k * steps.valves]; };
      sensor::Estimate<double>& answer = runs[lane]->answers[from + row];
      answer = {number(0), number(1), number(2),
                number(3), number(4), number(5),
                number(6), number(7), static_cast<sensor::Status>(std::bit_cast<std::int64_t>(number(8)))};
      runs[lane]->sensor->tell(answer, given_[row * steps.valves + lane]);
    }
  }
}

}  // namespace spoolflow::estimation

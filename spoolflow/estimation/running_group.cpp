#include "spoolflow/estimation/running_group.hpp"

#include <algorithm>
#include <bit>
#include <new>
#include <stdexcept>
#include <string>

#include "spoolflow/numerics/members.hpp"

namespace spoolflow::estimation {
namespace {

using batch::NumberKind;

/// So many samples of all valves are brought side by side at a time.
constexpr std::size_t rows_at_once = 32;
/// Fewer valves are stepped one after the other (bench/valve_batch).
constexpr std::size_t least_together = 3;

const batch::GroupSteps* observer_steps(GroupRegisters registers) {
  if (registers == GroupRegisters::avx512) return &batch::observer_group_avx512;
  return registers == GroupRegisters::avx2 ? &batch::observer_group_avx2 : nullptr;
}
const batch::GroupSteps* whole_valve_steps(GroupRegisters registers) {
  if (registers == GroupRegisters::avx512) return &batch::whole_valve_group_avx512;
  return registers == GroupRegisters::avx2 ? &batch::whole_valve_group_avx2 : nullptr;
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
std::span<const batch::NumberRun> runs_of_numbers() {
  static const std::vector<batch::NumberRun> runs = [] {
    std::vector<batch::NumberRun> out;
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

void RunningGroup::Kind::Free::operator()(void* memory) const {
  ::operator delete(memory, std::align_val_t(alignment));
}

RunningGroup::RunningGroup(GroupRegisters registers) {
  const auto known = group_registers();
  if (std::find(known.begin(), known.end(), registers) == known.end())
    throw std::invalid_argument("this processor or build has no registers of " + std::string(name(registers)));
  if (registers == GroupRegisters::one_valve) return;
  const auto begin = [](Kind& kind, const batch::GroupSteps* steps, std::span<const batch::NumberRun> runs) {
    kind.steps = steps;
    kind.state_runs = runs;
    kind.lanes = {::operator new(steps->bytes, std::align_val_t(steps->alignment)), {steps->alignment}};
  };
  begin(observers_, observer_steps(registers), runs_of_numbers<sensor::ObserverState<double>>());
  begin(whole_valves_, whole_valve_steps(registers), runs_of_numbers<sensor::WholeValveState<double>>());
  const std::size_t valves = observers_.steps->valves;
  samples_.resize(rows_at_once * valves * whole_valves_.steps->channels);
  answers_.resize(rows_at_once * valves * batch::numbers_of_an_answer);
  given_.resize(rows_at_once * valves);
}

void RunningGroup::step(std::span<const GroupedRun> runs) {
  for (const GroupedRun& run : runs) {
    if (run.answers.size() != run.samples.size()) {
      throw std::invalid_argument("a run of " + std::to_string(run.samples.size()) + " samples has room for " +
                                  std::to_string(run.answers.size()) + " answers");
    }
    Kind& kind = run.sensor->runs_whole() ? whole_valves_ : observers_;
    const auto has_ports = [](const TimedSample& sample) { return measured(sample.ports); };
    const bool alone = kind.steps == nullptr || run.sensor->runs_condensed() ||
                       (run.sensor->runs_whole() && std::any_of(run.samples.begin(), run.samples.end(), has_ports));
    if (alone) {
      step_alone(run, 0);
    } else {
      kind.runs.push_back(&run);
    }
  }
  for (Kind* const kind : {&observers_, &whole_valves_}) step(*kind);
}

/// Runs of about one length together: whose samples are over has nothing to do.
void RunningGroup::step(Kind& kind) {
  std::stable_sort(kind.runs.begin(), kind.runs.end(), [](const GroupedRun* one, const GroupedRun* other) {
    return one->samples.size() > other->samples.size();
  });
  for (std::span<const GroupedRun* const> left = kind.runs; !left.empty();) {
    const std::size_t count = std::min(left.size(), kind.steps->valves);
    step_together(kind, left.first(count));
    left = left.subspan(count);
  }
  kind.runs.clear();
}

/// The longest first. Lanes that are left over, or whose samples are over, do as the first one does.
void RunningGroup::step_together(Kind& kind, std::span<const GroupedRun* const> runs) {
  const batch::GroupSteps& steps = *kind.steps;
  std::size_t done = 0;
  if (runs.size() >= least_together) {
    std::vector<const void*> models(2 * steps.valves);
    for (std::size_t lane = 0; lane < steps.valves; ++lane) {
      const auto [b, a] = models_of(*runs[lane < runs.size() ? lane : 0]->sensor);
      models[lane] = b;
      models[lane + steps.valves] = a;
    }
    if (!steps.begin(kind.lanes.get(), models.data())) throw std::logic_error("a model has more numbers than a group");
    for (std::size_t lane = 0; lane < steps.valves; ++lane)
      steps.load(kind.lanes.get(), lane, state_of(*runs[lane < runs.size() ? lane : 0]->sensor), kind.state_runs);
    while (runs.size() >= least_together) {
      const std::size_t until = runs.back()->samples.size();
      for (; done < until; done += std::min(rows_at_once, until - done))
        step_rows(kind, runs, done, std::min(rows_at_once, until - done));
      while (!runs.empty() && runs.back()->samples.size() == until) {
        steps.store(kind.lanes.get(), runs.size() - 1, state_of(*runs.back()->sensor), kind.state_runs);
        runs = runs.first(runs.size() - 1);
      }
    }
    for (std::size_t lane = 0; lane < runs.size(); ++lane)
      steps.store(kind.lanes.get(), lane, state_of(*runs[lane]->sensor), kind.state_runs);
  }
  for (const GroupedRun* const run : runs) step_alone(*run, done);
}

void RunningGroup::put_sample(const Kind& kind, std::size_t row, std::size_t lane, const GroupedRun& run,
                              TimedSample sample) {
  const std::size_t valves = kind.steps->valves;
  SteppedSample<double>& given = given_[row * valves + lane] = run.sensor->take(sample);
  double* const at = samples_.data() + row * kind.steps->channels * valves + lane;
  const auto put = [&](auto... numbers) {
    std::size_t channel = 0;
    ((at[valves * channel++] = numbers), ...);
  };
  if (run.sensor->runs_whole()) {
    const auto whole = whole_valve_sample(given.sample, sample);
    put(whole.time_step_s, whole.current_a_A, whole.current_b_A, whole.voltage_a_V, whole.voltage_b_V, whole.position_m,
        whole.oil_temperature_K);
  } else {
    const auto& one = given.sample;
    put(one.time_step_s, one.current_A, one.voltage_V, one.position_m, one.oil_temperature_K);
  }
}

void RunningGroup::step_rows(Kind& kind, std::span<const GroupedRun* const> runs, std::size_t from, std::size_t count) {
  const std::size_t valves = kind.steps->valves, channels = kind.steps->channels;
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t lane = 0; lane < runs.size(); ++lane)
      put_sample(kind, row, lane, *runs[lane], runs[lane]->samples[from + row]);
    double* const first = samples_.data() + row * channels * valves;
    for (std::size_t channel = 0; channel < channels; ++channel) {
      double* const lanes = first + channel * valves;
      std::fill(lanes + runs.size(), lanes + valves, lanes[0]);
    }
  }
  kind.steps->step(kind.lanes.get(), samples_.data(), answers_.data(), count);
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t lane = 0; lane < runs.size(); ++lane) {
      const double* const at = answers_.data() + row * batch::numbers_of_an_answer * valves + lane;
      const auto number = [&](std::size_t k) { return at[k * valves]; };
      sensor::Estimate<double>& answer = runs[lane]->answers[from + row];
      answer = {number(0), number(1), number(2), number(3), number(4), number(5), number(6), number(7),
                static_cast<sensor::Status>(std::bit_cast<std::int64_t>(number(8)))};
      runs[lane]->sensor->tell(answer, given_[row * valves + lane]);
    }
  }
}

}  // namespace spoolflow::estimation

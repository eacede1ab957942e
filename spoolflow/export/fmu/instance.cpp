#include "spoolflow/export/fmu/instance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "spoolflow/export/fmu/number_text.hpp"
#include "spoolflow/export/state_bytes.hpp"

namespace spoolflow::exports::fmu {
namespace {

const char* name(Mode mode) {
  static constexpr std::array names{"instantiated", "initialization mode", "step mode", "terminated"};
  return names.at(static_cast<std::size_t>(mode));
}

std::vector<double> starts(const std::vector<Variable>& variables) {
  std::vector<double> values;
  for (const Variable& variable : variables) values.push_back(variable.start);
  return values;
}

/// A longer communication step is a mistake in its unit, and would be computed for minutes.
constexpr double most_samples_a_step = 1e7;
/// No instance has come so far: 50 us for 14 000 years.
constexpr std::int64_t most_sample = 9'000'000'000'000'000;

/// What rounding may do to a time near `time_s`, where samples are `step_s` apart.
double rounding_s(double time_s, double step_s) {
  return 1e-6 * step_s + 2e-15 * std::abs(time_s);
}

}  // namespace

Instance::Instance(std::unique_ptr<Component> component)
    : component_(std::move(component)), values_(starts(component_->variables())) {}

void Instance::require(Mode mode, const char* call) const {
  if (clock_.mode == mode) return;
  throw CallError(std::string(call) + " is not allowed here: the instance is in " + name(clock_.mode) +
                  ", it must be in " + name(mode));
}

void Instance::set_up(double start_time_s, bool stop_defined, double stop_time_s) {
  require(Mode::instantiated, "setting the start time");
  if (!std::isfinite(start_time_s)) throw CallError("the start time must be a number");
  if (stop_defined && !(stop_time_s >= start_time_s)) throw CallError("the stop time lies before the start time");
  clock_.start_s = clock_.reached_s = start_time_s;
  clock_.stop_s = stop_defined ? stop_time_s : 0;
  clock_.stop_defined = stop_defined ? 1 : 0;
}

void Instance::enter_initialization() {
  require(Mode::instantiated, "entering initialization mode");
  clock_.mode = Mode::initialization;
  clock_.stale = 1;
}

void Instance::preview() {
  component_->tune(values_);
  component_->start(values_);
  clock_.stale = 0;
}

void Instance::exit_initialization() {
  require(Mode::initialization, "leaving initialization mode");
  preview();
  clock_.step_s = component_->sample_step_s(values_);
  clock_.next = 0;
  clock_.tuned = 0;
  clock_.mode = Mode::step;
}

void Instance::terminate() {
  require(Mode::step, "terminating");
  clock_.mode = Mode::terminated;
}

void Instance::reset() {
  clock_ = Clock();
  values_ = starts(component_->variables());
}

void Instance::do_step(double time_s, double step_s) {
  require(Mode::step, "a step");
  if (!std::isfinite(time_s) || !std::isfinite(step_s)) throw StepRefused("time and step must be numbers");
  if (!(step_s > 0)) {
    throw StepRefused("a step of " + number_text(step_s) + " s at " + number_text(time_s) +
                      " s: time must advance, nothing was computed");
  }
  const double tolerance_s = 1e-3 * clock_.step_s + 1e-8 * std::abs(time_s);  // importers sum and round times, too
  if (std::abs(time_s - clock_.reached_s) > tolerance_s) {
    throw StepRefused("a step from " + number_text(time_s) + " s does not begin where the last one ended, at " +
                      number_text(clock_.reached_s) + " s; to go back, set a state that was kept there");
  }
  const double end_s = time_s + step_s;
  if (clock_.stop_defined != 0 && end_s > clock_.stop_s + tolerance_s) {
    throw CallError("the step goes to " + number_text(end_s) + " s, beyond the stop time of " +
                    number_text(clock_.stop_s) + " s");
  }
  if (clock_.tuned != 0) {
    component_->tune(values_);
    clock_.tuned = 0;
  }
  const double due = std::ceil((end_s - rounding_s(end_s, clock_.step_s) - clock_.start_s) / clock_.step_s);
  if (due - static_cast<double>(clock_.next) > most_samples_a_step) {
    throw StepRefused("a step of " + number_text(step_s) + " s takes " +
                      number_text(due - static_cast<double>(clock_.next)) + " samples, more than " +
                      number_text(most_samples_a_step) + ": cut it into shorter ones");
  }
  const std::int64_t until = due > 0 ? static_cast<std::int64_t>(std::min(due, 9e15)) : 0;  // of a wild start time
  for (; clock_.next < until; ++clock_.next) component_->sample(values_, clock_.next);
  clock_.reached_s = end_s;
  values_[0] = end_s;
}

const Variable& Instance::variable(std::uint32_t reference, Type type) const {
  const auto& all = component_->variables();
  if (reference >= all.size()) {
    throw CallError("there is no variable with value reference " + std::to_string(reference));
  }
  if (all[reference].type != type) throw CallError(all[reference].name + " is of another type");
  return all[reference];
}

double Instance::get(std::uint32_t reference, Type type) {
  const Variable& asked = variable(reference, type);
  if (asked.causality == Causality::output && clock_.mode == Mode::initialization && clock_.stale != 0) preview();
  if (asked.causality == Causality::independent) return clock_.reached_s;
  return values_[reference];
}

void Instance::check(std::uint32_t reference, Type type, double value) const {
  const Variable& asked = variable(reference, type);
  const bool parameter = asked.causality == Causality::parameter;
  if (!parameter && asked.causality != Causality::input) throw CallError(asked.name + " cannot be set");
  if (clock_.mode == Mode::terminated) throw CallError(asked.name + " cannot be set any more: terminated");
  if (parameter && asked.variability == Variability::fixed && clock_.mode == Mode::step) {
    throw CallError(asked.name + " is fixed: it can be set before and during initialization only");
  }
  if (parameter && !(std::isfinite(value) && !(value < asked.lowest) && !(value > asked.highest))) {
    throw CallError(asked.name + " = " + number_text(value) + " is outside " + number_text(asked.lowest) + " to " +
                    number_text(asked.highest) + (asked.unit.empty() || asked.unit == "1" ? "" : " " + asked.unit));
  }
}

void Instance::put(std::uint32_t reference, double value) {
  values_[reference] = value;
  if (component_->variables()[reference].causality == Causality::parameter) clock_.tuned = 1;
  clock_.stale = 1;
}

std::size_t Instance::state_size() {
  return sizeof clock_ + values_.size() * sizeof(double) + component_->memory().size();
}

StateBytes Instance::state() {
  component_->clear_padding();
  const std::span<char> memory = component_->memory();
  StateBytes plain(state_size());
  char* to = plain.data();
  std::memcpy(to, &clock_, sizeof clock_);
  std::memcpy(to + sizeof clock_, values_.data(), values_.size() * sizeof(double));
  std::memcpy(to + sizeof clock_ + values_.size() * sizeof(double), memory.data(), memory.size());
  StateBytes packed(packed_size(plain.size()));
  pack_state({component_->identity(), 0}, plain.data(), plain.size(), packed.data());
  return packed;
}

StateBytes Instance::unpacked(const StateBytes& state) {
  StateBytes plain(state_size());
  unpack_state({component_->identity(), 0}, state.data(), state.size(), plain.data(), plain.size());
  Clock clock;
  std::memcpy(&clock, plain.data(), sizeof clock);
  const auto flags = {clock.stop_defined, clock.tuned, clock.stale};
  const bool holds = clock.mode >= Mode::instantiated && clock.mode <= Mode::terminated && clock.next >= 0 &&
                     clock.next < most_sample && std::isfinite(clock.start_s) && std::isfinite(clock.reached_s) &&
                     std::isfinite(clock.stop_s) && std::isfinite(clock.step_s) &&
                     (clock.mode < Mode::step || clock.step_s > 0) &&
                     std::all_of(flags.begin(), flags.end(), [](std::uint32_t flag) { return flag <= 1; });
  const std::size_t before = sizeof clock + values_.size() * sizeof(double);
  if (!holds || !component_->may_be_memory(std::span<const char>(plain).subspan(before)))
    throw StateError("the state's bytes are damaged: they hold what no state can");
  return plain;
}

void Instance::check_state(const StateBytes& state) {
  (void)unpacked(state);
}

void Instance::set_state(const StateBytes& state) {
  const StateBytes plain = unpacked(state);
  Clock clock;
  std::vector<double> values(values_.size());
  const char* from = plain.data();
  std::memcpy(&clock, from, sizeof clock);
  std::memcpy(values.data(), from + sizeof clock, values.size() * sizeof(double));
  if (clock.mode != Mode::instantiated) component_->tune(values);  // what does not fit together throws: nothing is set
  clock_ = clock;
  values_ = std::move(values);
  const std::span<char> memory = component_->memory();
  std::memcpy(memory.data(), from + sizeof clock + values_.size() * sizeof(double), memory.size());
}

}  // namespace spoolflow::exports::fmu

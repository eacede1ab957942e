#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::estimation {
namespace {

std::shared_ptr<const sensor::CondensedTables<double>> laid_out(const sensor::CondensedParameters<double>& parameters) {
  auto tables = std::make_shared<sensor::CondensedTables<double>>();
  sensor::lay_out(parameters, *tables);
  return tables;
}

}  // namespace

void RunningSensor::parameters_changed() {
  if (const auto* condensed = std::get_if<const sensor::CondensedParameters<double>*>(&parameters_)) {
    condensed_ = laid_out(**condensed);
  } else if (const auto* whole = std::get_if<WholeCondensed>(&parameters_)) {
    condensed_ = laid_out(*whole->b);
    condensed_a_ = laid_out(*whole->a);
  }
  limits_ = limits();
}

void RunningSensor::step(TimedSample sample, sensor::Estimate<double>& out) {
  const SteppedSample given = take(sample);
  out = answer(given.sample, sample);
  complete(out, given);
}

/// How the estimator gets the sample, from which it takes out what is implausible.
SteppedSample RunningSensor::take(TimedSample& sample) {
  const sensor::Status fault =
      take_out_implausible(limits_, sample) | take_out_hanging(limits_, state_.position, sample);
  auto given = state_.times.next(sample);
  given.fault = fault;
  if (runs_whole() && std::isinf(sample.current_a_A)) given.sample.current_A = not_measured;
  return given;
}

/// Completes the answer to it.
void RunningSensor::complete(sensor::Estimate<double>& answer, const SteppedSample& given) {
  if (!is_ordered(answer)) answer = began_anew();
  state_.times.finish(answer, given, rated_flow_m3_per_s_);
  if (runs_whole() && !state_.times.answered) answer.flow_lower_m3_per_s = -rated_flow_m3_per_s_;
}

/// What a memory that leads to no number is good for: nothing. It is as new, and the answer that before a first sample.
[[gnu::noinline]] sensor::Estimate<double> RunningSensor::began_anew() {
  const SampleTimes times{state_.times.last_time_s, state_.times.started, false};
  reset();
  state_.times.last_time_s = times.last_time_s;
  state_.times.started = times.started;
  sensor::Estimate<double> out;
  out.flow_lower_m3_per_s = runs_whole() ? -rated_flow_m3_per_s_ : 0;
  out.flow_upper_m3_per_s = rated_flow_m3_per_s_;
  out.status = sensor::Status::sample_missing;
  return out;
}

SolenoidLimits RunningSensor::limits() const {
  if (const auto* observer = std::get_if<const sensor::ObserverParameters<double>*>(&parameters_))
    return solenoid_limits(**observer);
  if (const auto* whole = std::get_if<sensor::WholeValveParameters<double>>(&parameters_))
    return solenoid_limits(*whole);
  return {coil_limits(*condensed_), coil_limits(condensed_a_ ? *condensed_a_ : *condensed_)};
}

// All in one piece where it is optimised: an observer's sample takes 15 % less time than with calls of the step's
// parts, of which the linker may take copies that another file was given less optimisation for. The same instructions
// with three operands instead of two, where the processor has them (AVX): another 5 % less, the same numbers.
#if defined(__OPTIMIZE__) && defined(__x86_64__) && defined(__GLIBC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
[[gnu::flatten, gnu::target_clones("avx", "default")]]
#elif defined(__OPTIMIZE__)
[[gnu::flatten]]
#endif
const sensor::Estimate<double>&
RunningSensor::answer(const sensor::Sample<double>& sample, const TimedSample& measured) {
  if (const auto* observer = std::get_if<const sensor::ObserverParameters<double>*>(&parameters_))
    return sensor::step(**observer, state_.observer, sample);
  if (const auto* whole = std::get_if<sensor::WholeValveParameters<double>>(&parameters_))
    return sensor::step(*whole, state_.whole_valve, whole_valve_sample(sample, measured));
  if (std::holds_alternative<WholeCondensed>(parameters_)) {
    return sensor::step(sensor::WholeCondensedTables<double>{condensed_.get(), condensed_a_.get()},
                        state_.whole_condensed, whole_valve_sample(sample, measured));
  }
  return sensor::step(*condensed_, state_.condensed, sample);
}

}  // namespace spoolflow::estimation

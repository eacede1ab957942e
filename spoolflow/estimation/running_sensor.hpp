#pragma once
/// One sensor of a model in operation, driven by the time of its samples: what `estimate`, the C interface and the FMU
/// share. Needs nothing but the core.
#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>
#include <variant>

#include "spoolflow/estimation/coil_limits.hpp"
#include "spoolflow/estimation/still_position.hpp"
#include "spoolflow/estimation/timed_sample.hpp"
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer.hpp"
#include "spoolflow/sensor/whole_valve/whole_condensed.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"

namespace spoolflow::estimation {

/// Takes out of a sample what none of the valve's coils carries: that current or voltage is then missing. Returns the
/// fault to report.
inline sensor::Status take_out_implausible(const SolenoidLimits& limits, TimedSample& sample) {
  const auto& [b, a] = limits;
  const bool both_coils = !std::isnan(sample.current_a_A);  // else the current is the active coil's, whichever that is
  const CoilLimits& active = both_coils || a.current_A < b.current_A ? b : a;
  constexpr double now = std::numeric_limits<double>::infinity();  // see of_both_coils
  bool out = take_away(sample.current_A, active.current_A, not_measured);
  out = take_away(sample.voltage_V, active.voltage_V, not_measured) || out;
  out = take_away(sample.current_a_A, a.current_A, now) || out;
  out = take_away(sample.voltage_a_V, a.voltage_V, not_measured) || out;
  return sensor::when(out, sensor::Status::coil_fault);
}

/// Takes a position out of a sample that hangs: it is then missing. Returns the fault to report.
inline sensor::Status take_out_hanging(const SolenoidLimits& limits, StillPosition& position, TimedSample& sample) {
  const bool both_coils = std::isfinite(sample.current_a_A);
  const double current_A = both_coils ? sample.current_A - sample.current_a_A : sample.current_A;
  const bool hangs = position.hangs(sample.position_m, current_A, limits.b.current_A / implausible_current_ratio);
  if (hangs) sample.position_m = not_measured;
  return sensor::when(hangs, sensor::Status::position_fault);
}

/// The same as the sensor takes it.
struct SteppedSample {
  sensor::Sample<double> sample;
  bool repeated;                                ///< a second look at the same instant
  sensor::Status fault = sensor::Status::none;  ///< of what was taken out of it
};

/// How samples that carry times become the sensor's, and what is answered before any was complete.
struct SampleTimes {
  double last_time_s = 0;
  bool started = false;   ///< a sample came in
  bool answered = false;  ///< a complete one did

  /// The time step is zero at first, and NaN where the time is no number.
  SteppedSample next(const TimedSample& sample) {
    double step_s = std::numeric_limits<double>::quiet_NaN();
    const bool repeated = started && sample.time_s == last_time_s;
    if (std::isfinite(sample.time_s)) {
      step_s = started ? sample.time_s - last_time_s : 0.0;
      started = true;
      last_time_s = sample.time_s;
    }
    return {{step_s, sample.current_A, sample.voltage_V, sample.position_m, sample.oil_temperature_K}, repeated};
  }
  /// Completes the sensor's answer with the status of its inputs.
  void finish(sensor::Estimate<double>& answer, const SteppedSample& given, double rated_flow_m3_per_s) {
    if (!answered) {
      answered = sensor::unusable(given.sample) == sensor::Status::none;
      if (!answered) answer.flow_upper_m3_per_s = rated_flow_m3_per_s;
    }
    answer.status |= given.fault;
    if (given.repeated) answer.status |= sensor::Status::time_fault;
  }
};

/// The same as a whole valve's sensor takes it: without the current of solenoid a there is but the active coil's, and
/// the other is taken to carry none.
inline sensor::WholeValveSample<double> whole_valve_sample(const sensor::Sample<double>& b, const TimedSample& sample) {
  sensor::WholeValveSample<double> out{b.time_step_s, sample.current_a_A, b.current_A,        sample.voltage_a_V,
                                       b.voltage_V,   b.position_m,       b.oil_temperature_K};
  out.ports = sample.ports;
  if (!std::isnan(sample.current_a_A)) return out;
  out.current_a_A = 0;
  if (b.position_m < 0) {
    std::swap(out.current_a_A, out.current_b_A);
    std::swap(out.voltage_a_V, out.voltage_b_V);
  }
  return out;
}

/// What a running sensor remembers; trivially copyable, and so are its bytes.
struct RunningState {
  sensor::CondensedState<double> condensed;  ///< of these, that of the estimator that runs
  sensor::ObserverState<double> observer;
  sensor::WholeCondensedState<double> whole_condensed;
  sensor::WholeValveState<double> whole_valve;
  SampleTimes times;
  StillPosition position;
};
static_assert(std::is_trivially_copyable_v<RunningState>);

class RunningSensor {
 public:
  /// A whole valve's condensed parameters.
  struct WholeCondensed {
    const sensor::CondensedParameters<double>* b;  ///< flow P to B
    const sensor::CondensedParameters<double>* a;  ///< flow P to A
  };
  /// Parameters of the estimator that runs; kept by reference.
  using Parameters = std::variant<const sensor::CondensedParameters<double>*, const sensor::ObserverParameters<double>*,
                                  WholeCondensed, sensor::WholeValveParameters<double>>;

  RunningSensor(Parameters parameters, double rated_flow_m3_per_s)
      : parameters_(parameters), rated_flow_m3_per_s_(rated_flow_m3_per_s) {
    parameters_changed();
  }

  /// To be called after the parameters were written to.
  void parameters_changed();

  /// One sample. A current or voltage that no coil of the valve carries is missing, and coil_fault says so; a position
  /// that hangs is missing, and position_fault says so (StillPosition). A repeated time is a second look at the same
  /// instant, a time that runs backwards holds the last answer; both say time_fault, and the next time step counts from
  /// the new time. Before the first complete sample the flow is zero with a band over the whole rated flow, of a whole
  /// valve to both sides.
  sensor::Estimate<double> step(const TimedSample& sample) {
    sensor::Estimate<double> out;
    step(sample, out);
    return out;
  }
  /// The same into where it is to stand.
  void step(TimedSample sample, sensor::Estimate<double>& out);

  /// Numbers, the flow inside its band.
  [[nodiscard]] static bool is_ordered(const sensor::Estimate<double>& answer) {
    return answer.flow_lower_m3_per_s <= answer.flow_m3_per_s && answer.flow_m3_per_s <= answer.flow_upper_m3_per_s &&
           std::isfinite(answer.flow_upper_m3_per_s - answer.flow_lower_m3_per_s);
  }

  /// As new.
  void reset() { state_ = RunningState(); }

  [[nodiscard]] bool runs_condensed() const {
    return std::holds_alternative<const sensor::CondensedParameters<double>*>(parameters_) ||
           std::holds_alternative<WholeCondensed>(parameters_);
  }
  /// Both directions of flow.
  [[nodiscard]] bool runs_whole() const {
    return std::holds_alternative<WholeCondensed>(parameters_) ||
           std::holds_alternative<sensor::WholeValveParameters<double>>(parameters_);
  }
  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] const RunningState& state() const { return state_; }
  [[nodiscard]] RunningState& state() { return state_; }
  void set_state(const RunningState& state) { state_ = state; }

 private:
  using Tables = std::shared_ptr<const sensor::CondensedTables<double>>;

  SteppedSample take(TimedSample& sample);
  void complete(sensor::Estimate<double>& answer, const SteppedSample& given);
  sensor::Estimate<double> began_anew();
  [[nodiscard]] SolenoidLimits limits() const;
  const sensor::Estimate<double>& answer(const sensor::Sample<double>& sample, const TimedSample& measured);

  Parameters parameters_;
  Tables condensed_;  ///< the parameters, laid out
  Tables condensed_a_;
  SolenoidLimits limits_;
  double rated_flow_m3_per_s_;
  RunningState state_;
};

}  // namespace spoolflow::estimation

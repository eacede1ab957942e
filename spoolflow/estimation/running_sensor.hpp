#pragma once
/// One sensor of a model in operation, driven by the time of its samples: what `estimate`, the C interface and the FMU
/// share. Needs nothing but the core.
#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>
#include <variant>

#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::estimation {

/// What is measured at one instant. NaN means not measured.
struct TimedSample {
  double time_s;
  double current_A;
  double voltage_V;
  double position_m;
  double oil_temperature_K;
};

/// The same as the sensor takes it.
template <class T>
struct SteppedSample {
  sensor::Sample<T> sample;
  bool repeated;  ///< a second look at the same instant
};

/// How samples that carry times become the sensor's, and what is answered before any was complete.
struct SampleTimes {
  double last_time_s = 0;
  bool started = false;   ///< a sample came in
  bool answered = false;  ///< a complete one did

  /// The time step is zero at first, and NaN where the time is no number.
  template <class T>
  SteppedSample<T> next(const TimedSample& sample) {
    double step_s = std::numeric_limits<double>::quiet_NaN();
    const bool repeated = started && sample.time_s == last_time_s;
    if (std::isfinite(sample.time_s)) {
      step_s = started ? sample.time_s - last_time_s : 0.0;
      started = true;
      last_time_s = sample.time_s;
    }
    return {{T(step_s), T(sample.current_A), T(sample.voltage_V), T(sample.position_m), T(sample.oil_temperature_K)},
            repeated};
  }
  /// Makes the sensor's answer to it what is told.
  template <class T>
  void finish(sensor::Estimate<T>& answer, const SteppedSample<T>& given, double rated_flow_m3_per_s) {
    if (!answered) {
      answered = sensor::unusable(given.sample) == sensor::Status::none;
      if (!answered) answer.flow_upper_m3_per_s = T(rated_flow_m3_per_s);
    }
    if (given.repeated) answer.status |= sensor::Status::time_fault;
  }
};

/// What a running sensor remembers; trivially copyable, and so are its bytes.
struct RunningState {
  sensor::CondensedState<double> condensed;  ///< of the two, that of the estimator that runs
  sensor::ObserverState<double> observer;
  SampleTimes times;
};
static_assert(std::is_trivially_copyable_v<RunningState>);

class RunningSensor {
 public:
  /// Parameters of the estimator that runs; kept by reference.
  using Parameters =
      std::variant<const sensor::CondensedParameters<double>*, const sensor::ObserverParameters<double>*>;

  RunningSensor(Parameters parameters, double rated_flow_m3_per_s)
      : parameters_(parameters), rated_flow_m3_per_s_(rated_flow_m3_per_s) {
    parameters_changed();
  }

  /// To be called after the parameters were written to.
  void parameters_changed() {
    if (!runs_condensed()) return;
    const auto tables = std::make_shared<sensor::CondensedTables<double>>();
    sensor::lay_out(*std::get<0>(parameters_), *tables);
    condensed_ = tables;
  }

  /// One sample. A repeated time is a second look at the same instant, a time that runs backwards holds the last
  /// answer; both say time_fault, and the next time step counts from the new time. Before the first complete sample the
  /// flow is zero with a band over the whole rated flow.
  sensor::Estimate<double> step(const TimedSample& sample) {
    const auto given = state_.times.next<double>(sample);
    sensor::Estimate<double> out = std::holds_alternative<const sensor::ObserverParameters<double>*>(parameters_)
                                       ? sensor::step(*std::get<1>(parameters_), state_.observer, given.sample)
                                       : sensor::step(*condensed_, state_.condensed, given.sample);
    state_.times.finish(out, given, rated_flow_m3_per_s_);
    return out;
  }

  /// As new.
  void reset() { state_ = RunningState(); }

  [[nodiscard]] bool runs_condensed() const { return parameters_.index() == 0; }
  [[nodiscard]] const RunningState& state() const { return state_; }
  [[nodiscard]] RunningState& state() { return state_; }
  void set_state(const RunningState& state) { state_ = state; }

 private:
  Parameters parameters_;
  std::shared_ptr<const sensor::CondensedTables<double>> condensed_;  ///< the parameters, laid out
  double rated_flow_m3_per_s_;
  RunningState state_;
};

}  // namespace spoolflow::estimation

#pragma once
/// One valve's condition, followed sample by sample: the samples and what the sensor answered to them go in,
/// indicators, causes and the sign of NE 107 come out. Causal, of fixed size, without input or output; the state is
/// plain memory.
///
///     monitor::Monitor watch(model);                           // or with a baseline learnt from the valve itself
///     watch.take(samples, answers);                          // as many at a time as there are
///     watch.condition(); watch.causes(); watch.indicators();
///     const monitor::MonitorState kept = watch.state();        // trivially copyable: keep its bytes
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/monitor/adaptation.hpp"
#include "spoolflow/monitor/baseline.hpp"
#include "spoolflow/monitor/command_response.hpp"
#include "spoolflow/monitor/condition.hpp"
#include "spoolflow/monitor/direction_monitor.hpp"
#include "spoolflow/monitor/dither_health.hpp"
#include "spoolflow/monitor/doubt.hpp"
#include "spoolflow/monitor/status_share.hpp"
#include "spoolflow/monitor/usage.hpp"

namespace spoolflow::monitor {

/// Grows with the layout of MonitorState; kept state of another version is not taken.
inline constexpr std::uint32_t watch_state_version = 4;

struct Options {
  double false_alarms_per_year = 1;  ///< wanted, over all indicators of one valve, > 0
};

/// All that a watch remembers.
struct MonitorState {
  std::uint32_t version = watch_state_version;
  bool started = false;
  double last_time_s = 0;
  double oil_temperature_K = 0;  ///< smoothed; 0 before it was measured
  Usage usage;
  StatusShares status;
  CommandResponse response;
  DitherHealth dither;
  std::array<DirectionState, 2> side;  ///< of solenoids b and a; a valve of one direction has the first
  CentreRest centre;                   ///< of a whole valve
};
static_assert(std::is_trivially_copyable_v<MonitorState>);

class Monitor {
 public:
  /// Keeps a reference to the model. Throws ModelError where it has no observer, or where the baseline is of another.
  explicit Monitor(const model::Model& model, const Options& options = {},
                   const std::optional<Baseline>& baseline = {});

  /// The next samples, as a span or as estimation::Columns, and the observer's answers to them, equally many. Samples
  /// that the sensor held are counted by their status and identify nothing else. Throws std::invalid_argument where
  /// their numbers differ.
  template <class Samples>
  void take(const Samples& samples, std::span<const sensor::Estimate<double>> answers) {
    if (samples.size() != answers.size()) throw std::invalid_argument("as many answers as samples are needed");
    for (std::size_t k = 0; k < answers.size(); ++k) take(samples[k], answers[k]);
  }
  /// `position_set_m`: the command of that instant, in the position's signs; NaN: not known.
  void take(const estimation::TimedSample& sample, const sensor::Estimate<double>& answer,
            double position_set_m = estimation::not_measured);
  /// The recording is over, or the valve is taken off: what was gathered is judged.
  void finish();

  [[nodiscard]] std::vector<Indicator> indicators() const;
  /// What explains the indicators that are raised, the likeliest first. Before any is, what windows of steady pressure
  /// make ten times likelier than not: suspected, and not part of condition(). Else empty.
  [[nodiscard]] std::vector<Cause> causes() const;
  [[nodiscard]] Ne107 condition() const;
  /// What the raised indicators say against the model, for `widened`; changes with a window at most.
  [[nodiscard]] Doubt doubt() const;
  /// The same with what `adapted` needs to put it right in the model.
  [[nodiscard]] Findings findings() const;
  /// Windows of events that were judged.
  [[nodiscard]] double judged_windows() const;
  /// What was learnt, to compare later runs of the same valve and model with.
  [[nodiscard]] Baseline learnt() const;
  [[nodiscard]] const Usage& usage() const { return state_.usage; }
  /// Share of the time, mostly of the last ten minutes, in which the forces asked for a higher pressure difference than
  /// is calibrated. 0 of a model whose environment declares a higher one, and of less than 20 s.
  [[nodiscard]] double beyond_pressure_share() const;
  [[nodiscard]] const MonitorState& state() const { return state_; }
  /// Goes on from there. Returns false, and takes nothing, where it is of another version or holds what is no number.
  [[nodiscard]] bool set_state(const MonitorState& state);

 private:
  [[nodiscard]] std::size_t sides() const { return model_->whole() ? 2 : 1; }
  void take_motion(const estimation::TimedSample& sample, const sensor::Estimate<double>& answer, double time_step_s);
  void take_centre(const estimation::TimedSample& sample, double time_step_s);
  void take_command(double position_set_m, double position_m, double time_step_s);
  const model::Model* model_;
  std::array<DirectionReference, 2> reference_;
  Limits limits_;
  double dither_amplitude_A_ = 0, dither_frequency_Hz_ = 0;  ///< of the baseline; 0: not known
  MonitorState state_;
};

}  // namespace spoolflow::monitor

#pragma once
/// One valve's condition, followed sample by sample: the samples and what the sensor answered to them go in,
/// indicators, causes and the sign of NE 107 come out. Causal, of fixed size, without input or output; the state is
/// plain memory.
///
///     monitor::Watch watch(model);                           // or with a baseline learnt from the valve itself
///     watch.take(samples, answers);                          // as many at a time as there are
///     watch.condition(); watch.causes(); watch.indicators();
///     const monitor::WatchState kept = watch.state();        // trivially copyable: keep its bytes
#include <optional>
#include <span>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/monitor/condition.hpp"
#include "spoolflow/monitor/status_share.hpp"
#include "spoolflow/monitor/usage.hpp"
#include "spoolflow/monitor/winding.hpp"

namespace spoolflow::monitor {

/// Grows with the layout of WatchState; kept state of another version is not taken.
inline constexpr std::uint32_t watch_state_version = 1;

/// All that a watch remembers.
struct WatchState {
  std::uint32_t version = watch_state_version;
  bool started = false;
  double last_time_s = 0;
  double oil_temperature_K = 0;
  Usage usage;
  StatusShares status;
  std::array<WindingState, 2> winding;  ///< of solenoids b and a; a valve of one direction has the first
};
static_assert(std::is_trivially_copyable_v<WatchState>);

class Watch {
 public:
  /// Keeps a reference to the model. Throws ModelError where it has no observer.
  explicit Watch(const model::Model& model);

  /// The next samples and the observer's answers to them, equally many. Samples that the sensor held are counted by
  /// their status and tell nothing else. Throws std::invalid_argument where their numbers differ.
  void take(std::span<const estimation::TimedSample> samples, std::span<const sensor::Estimate<double>> answers);
  void take(const estimation::TimedSample& sample, const sensor::Estimate<double>& answer);

  [[nodiscard]] std::vector<Indicator> indicators() const;
  /// What explains the indicators that are raised, the likeliest first; empty where none is.
  [[nodiscard]] std::vector<Cause> causes() const;
  [[nodiscard]] Ne107 condition() const;

  [[nodiscard]] const Usage& usage() const { return state_.usage; }
  [[nodiscard]] const WatchState& state() const { return state_; }
  /// Goes on from there. Returns false, and takes nothing, where it is of another version.
  [[nodiscard]] bool set_state(const WatchState& state);

 private:
  [[nodiscard]] const sensor::ObserverParameters<double>& side(bool opens_a) const;
  const model::Model* model_;
  WatchState state_;
};

}  // namespace spoolflow::monitor

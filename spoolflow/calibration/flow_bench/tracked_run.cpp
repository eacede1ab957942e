#include "spoolflow/calibration/flow_bench/tracked_run.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/calibration/fits/bench_strokes.hpp"
#include "spoolflow/calibration/fits/position_sensor.hpp"
#include "spoolflow/calibration/numerics/passage.hpp"
#include "spoolflow/sensor/signals/dither.hpp"
#include "spoolflow/sensor/signals/position_track.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;

constexpr double hardest_acceleration_m_per_s2 = 90;
/// Towards the ends of the stroke the spool meets its stops.
constexpr double end_stroke_share = 0.015;
/// One sample of so many seconds counts: neighbours share their noise.
constexpr double counted_every_s = 4e-3;

/// How far the spool has slid one way.
class Sliding {
 public:
  /// Whether friction is that of sliding by now.
  bool worn(const sensor::PositionPoint<double>& point) {
    const double way = point.motion == sensor::Motion::opening ? 1 : point.motion == sensor::Motion::closing ? -1 : 0;
    if (way == 0 || way != way_) {
      way_ = way;
      from_m_ = point.position_m;
      return false;
    }
    return way * (point.position_m - from_m_) > wearing_m;
  }

 private:
  double way_ = 0, from_m_ = 0;
};

SolenoidSamples coil_samples(const recording::Recording& recording, double closed_m) {
  const auto time_s = recording[Channel::time];
  SolenoidSamples out;
  out.file = recording.file.filename().string();
  out.voltage_measured = recording.has(Channel::voltage);
  for (std::size_t k = 0; k < recording.size(); ++k) {
    sensor::Sample<double> sample{};
    const bool first = k == 0;
    sample.time_step_s = first ? 0.0 : time_s[k] - time_s[k - 1];
    sample.current_A = recording[Channel::current][k];
    sample.voltage_V = out.voltage_measured ? recording[Channel::voltage][k] : std::nan("");
    sample.position_m = recording[Channel::position][k] - closed_m;
    if (std::isnan(sample.current_A) && !first) sample.current_A = out.samples.back().current_A;
    if (std::isnan(sample.position_m) && !first) sample.position_m = out.samples.back().position_m;
    if (std::isnan(sample.current_A)) sample.current_A = 0;
    if (std::isnan(sample.position_m)) sample.position_m = 0;
    out.samples.push_back(sample);
    out.time_s.push_back(time_s[k]);
    out.restarts.push_back(first ? 1 : 0);
  }
  out.force_N.assign(out.size(), std::nan(""));
  out.test.assign(out.size(), 0);
  return out;
}

}  // namespace

std::vector<double> pressure_difference_Pa(const recording::Recording& recording) {
  if (recording.has(Channel::pressure_difference)) return recording.column(Channel::pressure_difference);
  if (!recording.has(Channel::pressure_upstream) || !recording.has(Channel::pressure_downstream)) return {};
  std::vector<double> out = recording.column(Channel::pressure_upstream);
  const auto downstream = recording[Channel::pressure_downstream];
  for (std::size_t k = 0; k < out.size(); ++k) out[k] -= downstream[k];
  return out;
}

TrackedRun track_run(const recording::Recording& recording, double stroke_m, bool pressurised) {
  const auto position_m = recording[Channel::position];
  TrackedRun out{
      coil_samples(recording, closed_reading_m(position_m, stroke_m)), mean_oil_temperature_K(recording), {}, {}, 0};
  const std::vector<double> pressure_Pa = pressurised ? pressure_difference_Pa(recording) : std::vector<double>{};
  const double noise_m = noise_of(position_m);
  const sensor::PositionSensor<double> position_sensor{std::isnan(noise_m) ? 1e-6 : noise_m, 0, 0, 0,
                                                       hardest_acceleration_m_per_s2};
  sensor::PositionState<double> state;
  sensor::begin(state, out.coil.samples.empty() ? 0.0 : out.coil.samples.front().position_m);
  sensor::DitherState<double> dither_state;
  double largest_A = 0;
  for (const auto& sample : out.coil.samples) largest_A = std::max(largest_A, std::abs(sample.current_A));
  const sensor::QuietCoil<double> coil{sensor::quiet_current_share * largest_A, 0};  // its voltage is not asked
  sensor::begin(dither_state, out.coil.samples.empty() ? 0.0 : out.coil.samples.front().current_A);
  Sliding sliding;
  Passage passage;
  double counted_s = -INFINITY;
  for (std::size_t k = 0; k < out.coil.size(); ++k) {
    const auto& sample = out.coil.samples[k];
    const auto dither = sensor::follow_dither(dither_state, sample.current_A, largest_A, sample.time_step_s);
    const auto point = sensor::track(position_sensor, state, sample, coil, 0.0, dither, false, [] { return 0.0; });
    const bool evenly = sliding.worn(point);
    if (!passage.goes_on(k, out.coil.time_s[k], point.position_m)) {
      while (!out.passing.empty() && out.passing.back().sample > passage.went_on()) out.passing.pop_back();
    }
    const double end_m = end_stroke_share * stroke_m;
    if (is_doubted(state) || dither.present || point.position_m < end_m || point.position_m > stroke_m - end_m)
      continue;
    if (!(evenly || passage.worn()) || out.coil.time_s[k] < counted_s + counted_every_s) continue;
    const double dp_Pa = pressure_Pa.empty() ? 0.0 : pressure_Pa[k];
    if (std::isnan(dp_Pa)) continue;
    counted_s = out.coil.time_s[k];
    SlidingSample counted{k, point.position_m, passage.way(), point.acceleration_m_per_s2, dp_Pa};
    if (passage.worn()) out.passing.push_back(counted);
    counted.direction = point.motion == sensor::Motion::opening ? 1.0 : -1.0;
    if (evenly) out.sliding.push_back(counted);
  }
  return out;
}

}  // namespace spoolflow::calibration

#include "spoolflow/calibration/references/stalled_strokes.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/calibration/operation/replay.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::calibration {
namespace {

/// For how long the pressure difference must have fallen so far [s].
constexpr double stays_fallen_s = 0.05;

/// The sensor's answers to a recording.
struct SeenSample {
  double time_s, pressure_difference_Pa;
  bool open;
};

std::vector<SeenSample> seen_samples(const sensor::ObserverParameters<double>& valve, double rated_flow_m3_per_s,
                                     const recording::Recording& recording) {
  std::vector<SeenSample> out;
  estimation::RunningSensor sensor(&valve, rated_flow_m3_per_s);
  const estimation::Columns columns = operating_columns(recording);
  estimation::run(sensor, columns, [&](std::size_t k, const sensor::Estimate<double>& answer) {
    const bool shut = sensor::has(answer.status, sensor::Status::closed) ||
                      sensor::has(answer.status, sensor::Status::other_direction);
    out.push_back({columns.time_s[k], answer.pressure_difference_Pa, !shut});
  });
  return out;
}

std::vector<double> while_open_Pa(const std::vector<SeenSample>& samples) {
  std::vector<double> out;
  for (const SeenSample& each : samples)
    if (each.open) out.push_back(each.pressure_difference_Pa);
  return out;
}

}  // namespace

double fallen_Pa(std::vector<double> pressure_difference_Pa) {
  constexpr double fallen_share = 0.15, most_samples = 0.9;
  std::erase_if(pressure_difference_Pa, [](double value) { return !std::isfinite(value); });
  if (pressure_difference_Pa.empty()) return 0;
  const auto at = static_cast<std::ptrdiff_t>(most_samples * static_cast<double>(pressure_difference_Pa.size() - 1));
  std::ranges::nth_element(pressure_difference_Pa, pressure_difference_Pa.begin() + at);
  return fallen_share * pressure_difference_Pa[static_cast<std::size_t>(at)];
}

std::vector<recording::TimeMark> stalled_strokes(const sensor::ObserverParameters<double>& valve,
                                                 double rated_flow_m3_per_s, const recording::Recording& recording) {
  const std::vector<SeenSample> samples = seen_samples(valve, rated_flow_m3_per_s, recording);
  const double least_Pa = fallen_Pa(while_open_Pa(samples));
  std::vector<recording::TimeMark> out;
  bool from_the_end = false, stands = false;  // of the stroke before; now
  double left_s = NAN, fell_s = NAN;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const SeenSample &before = samples[k - 1], &now = samples[k];
    if (now.open && !before.open) {
      left_s = before.time_s;
      stands = false;
      fell_s = NAN;
    }
    if (!now.open && before.open) from_the_end = stands;
    if (!now.open || stands || std::isnan(left_s)) continue;
    if (now.pressure_difference_Pa >= least_Pa) {
      fell_s = NAN;
      continue;
    }
    if (std::isnan(fell_s)) fell_s = now.time_s;
    stands = now.time_s - fell_s >= stays_fallen_s;
    if (stands && from_the_end) out.push_back({left_s, fell_s, NAN});
  }
  return out;
}

}  // namespace spoolflow::calibration

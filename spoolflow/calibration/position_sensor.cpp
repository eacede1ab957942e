#include "spoolflow/calibration/position_sensor.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/calibration/bench_strokes.hpp"

namespace spoolflow::calibration {
namespace {

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double closed_reading_m(std::span<const double> position_m, double stroke_m) {
  std::vector<double> sorted;
  for (const double x : position_m) {
    if (!std::isnan(x)) sorted.push_back(x);
  }
  std::sort(sorted.begin(), sorted.end());
  // The lower end: everything within a four-hundredth of the stroke of the lowest hundredth of a percent.
  const double lowest = sorted[sorted.size() / 10000];
  std::vector<double> hold;
  for (const double x : sorted) {
    if (x > lowest + stroke_m / 400) break;
    hold.push_back(x);
  }
  return median_of(std::move(hold));
}

double noise_of(std::span<const double> position_m) {
  std::vector<double> differences;
  for (std::size_t k = 2; k < position_m.size(); ++k) {
    const double second = position_m[k] - 2 * position_m[k - 1] + position_m[k - 2];
    if (!std::isnan(second)) differences.push_back(std::abs(second));
  }
  if (differences.size() < 100) return std::nan("");
  return median_of(std::move(differences)) /
         (0.6745 * std::sqrt(6.0));  // MAD of a normal; a second difference adds 1, 4, 1
}

PositionSensorFit fit_position_sensor(const std::vector<const recording::Recording*>& recordings, double stroke_m) {
  using recording::Channel;
  std::vector<double> temperatures_K;
  std::vector<double> closed_m;
  std::vector<double> noises_m;
  for (const recording::Recording* recording : recordings) {
    const auto position_m = (*recording)[Channel::position];
    noises_m.push_back(noise_of(position_m));
    const double temperature_K = mean_oil_temperature_K(*recording);
    if (std::isnan(temperature_K)) continue;
    temperatures_K.push_back(temperature_K);
    closed_m.push_back(closed_reading_m(position_m, stroke_m));
  }
  std::erase_if(noises_m, [](double noise) { return std::isnan(noise); });
  PositionSensorFit fit{0, 323.15, 0, noises_m.empty() ? 1e-6 : median_of(noises_m)};
  if (temperatures_K.empty()) return fit;
  const auto n = static_cast<double>(temperatures_K.size());
  double mean_K = 0;
  double mean_m = 0;
  for (std::size_t k = 0; k < closed_m.size(); ++k) {
    mean_K += temperatures_K[k] / n;
    mean_m += closed_m[k] / n;
  }
  double covariance = 0;
  double variance = 0;
  for (std::size_t k = 0; k < closed_m.size(); ++k) {
    covariance += (temperatures_K[k] - mean_K) * (closed_m[k] - mean_m);
    variance += (temperatures_K[k] - mean_K) * (temperatures_K[k] - mean_K);
  }
  const auto [lowest_K, highest_K] = std::minmax_element(temperatures_K.begin(), temperatures_K.end());
  if (*highest_K - *lowest_K < 10) return fit;
  fit.drift_m_per_K = covariance / variance;
  fit.drift_free_K = std::abs(fit.drift_m_per_K) > 1e-10 ? mean_K - mean_m / fit.drift_m_per_K : mean_K;
  for (std::size_t k = 0; k < closed_m.size(); ++k) {
    const double deviation = closed_m[k] - fit.drift_m_per_K * (temperatures_K[k] - fit.drift_free_K);
    fit.drift_residual_m += deviation * deviation / n;
  }
  fit.drift_residual_m = std::sqrt(fit.drift_residual_m);
  return fit;
}

recording::Recording shifted(recording::Recording recording, double offset_m) {
  for (double& x : recording.column(recording::Channel::position)) x -= offset_m;
  return recording;
}

recording::Recording without_zero_offset(recording::Recording recording, double stroke_m) {
  const double closed_m = closed_reading_m(recording[recording::Channel::position], stroke_m);
  return shifted(std::move(recording), closed_m);
}

}  // namespace spoolflow::calibration

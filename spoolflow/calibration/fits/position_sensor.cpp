#include "spoolflow/calibration/fits/position_sensor.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/fits/bench_strokes.hpp"
#include "spoolflow/calibration/numerics/fitted_parameters.hpp"
#include "spoolflow/calibration/numerics/linear_least_squares.hpp"
#include "spoolflow/numerics/median.hpp"

namespace spoolflow::calibration {
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
  return numerics::median(std::move(hold));
}

double noise_of(std::span<const double> position_m) {
  std::vector<double> differences;
  for (std::size_t k = 2; k < position_m.size(); ++k) {
    const double second = position_m[k] - 2 * position_m[k - 1] + position_m[k - 2];
    if (!std::isnan(second)) differences.push_back(std::abs(second));
  }
  if (differences.size() < 100) return std::nan("");
  return numerics::median(std::move(differences)) /
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
  PositionSensorFit fit{0, 323.15, 0, noises_m.empty() ? 1e-6 : numerics::median(noises_m)};
  if (temperatures_K.empty()) return fit;
  const auto [lowest_K, highest_K] = std::minmax_element(temperatures_K.begin(), temperatures_K.end());
  if (*highest_K - *lowest_K < 10) return fit;
  const Eigen::Map<const Eigen::VectorXd> temperature(temperatures_K.data(),
                                                      static_cast<Eigen::Index>(temperatures_K.size()));
  const Eigen::Map<const Eigen::VectorXd> closed(closed_m.data(), temperature.size());
  const double mean_K = temperature.mean();
  Eigen::MatrixXd line(temperature.size(), 2);
  line << Eigen::VectorXd::Ones(temperature.size()), temperature.array() - mean_K;
  const LinearLeastSquares drift = least_squares(line, closed, "the drift of the position sensor");
  fit.drift_m_per_K = drift.solution(1);
  fit.drift_free_K = std::abs(fit.drift_m_per_K) > 1e-10 ? mean_K - drift.solution(0) / fit.drift_m_per_K : mean_K;
  fit.drift_residual_m = (closed - line * drift.solution).norm() / std::sqrt(static_cast<double>(closed.size()));
  if (closed.size() > 2) {
    fit.known =
        known_from_apart("drift of the position sensor",
                         {fmt::format("closed_reading_at_{:.0f}_K_m", mean_K), "position_drift_m_per_K"}, drift);
  }
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

#include "spoolflow/calibration/flow_bench/conductance_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "spoolflow/calibration/fits/bench_strokes.hpp"
#include "spoolflow/calibration/fits/position_sensor.hpp"
#include "spoolflow/numerics/equations/symmetric_equations.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;
constexpr int points = conductance_positions;
/// So much of a level's largest conductance its curve may bend from point to point.
constexpr double bend_share = 0.002;
constexpr double longest_lag_s = 0.2;
constexpr std::size_t counted_every = 4;  ///< samples that count; neighbours share their noise

/// The samples of all strokes.
struct MeteredStrokes {
  std::span<const double> time_s, flow_m3_per_s;
  std::vector<double> position_m, pressure_Pa;
};

struct LevelSolution {
  Eigen::VectorXd conductance;
  double sum_of_squares = 0, largest = 0;
  std::size_t samples = 0;
};

/// The shares of each point in the flow, as the meter shows it.
class LaggedShares {
 public:
  explicit LaggedShares(double stroke_m, double lag_s)
      : per_step_(static_cast<double>(points - 1) / stroke_m), lag_s_(lag_s) {}

  void step(double step_s, double position_m, double pressure_Pa) {
    const double share = lag_s_ > 0 && begun_ ? 1 - std::exp(-step_s / lag_s_) : 1;
    begun_ = true;
    for (double& each : shares_) each *= 1 - share;
    const double raw = std::clamp(position_m * per_step_, 0.0, static_cast<double>(points - 1));
    const int lower = std::min(static_cast<int>(raw), points - 2);
    const double root = std::sqrt(std::max(0.0, pressure_Pa));
    shares_[static_cast<std::size_t>(lower)] += share * root * (1 - (raw - lower));
    shares_[static_cast<std::size_t>(lower) + 1] += share * root * (raw - lower);
  }
  [[nodiscard]] Eigen::Map<const Eigen::VectorXd> shares() const { return {shares_.data(), points}; }

 private:
  std::array<double, points> shares_{};
  double per_step_, lag_s_;
  bool begun_ = false;
};

template <class Each>
void each_sample(const MeteredStrokes& strokes, const Sweep& from, const Sweep& to, double stroke_m, double lag_s,
                 Each&& each) {
  LaggedShares shares(stroke_m, lag_s);
  const double end_of_lag = 5 * lag_s + strokes.time_s[from.begin];
  for (std::size_t k = from.begin; k < to.end; ++k) {
    if (std::isnan(strokes.position_m[k]) || std::isnan(strokes.pressure_Pa[k])) continue;
    shares.step(k == 0 ? 0.0 : strokes.time_s[k] - strokes.time_s[k - 1], strokes.position_m[k],
                strokes.pressure_Pa[k]);
    if (k % counted_every != 0 || strokes.time_s[k] < end_of_lag || std::isnan(strokes.flow_m3_per_s[k])) continue;
    each(shares.shares(), strokes.flow_m3_per_s[k]);
  }
}

LevelSolution solve_level(const MeteredStrokes& strokes, const Level& level, double stroke_m, double lag_s) {
  const auto [first, last] = std::minmax_element(level.sweeps.begin(), level.sweeps.end(),
                                                 [](const Sweep& a, const Sweep& b) { return a.begin < b.begin; });
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(points, points);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(points);
  double largest = 0;
  each_sample(strokes, *first, *last, stroke_m, lag_s, [&](const auto& shares, double flow) {
    matrix.selfadjointView<Eigen::Lower>().rankUpdate(shares);
    right += flow * shares;
    largest = std::max(largest, std::abs(flow));
  });
  // Weights in units of the meter's noise, which is some thousandth of the largest flow.
  const double noise = std::max(1e-3 * largest, 1e-12);
  const double bend = bend_share * largest / std::sqrt(std::max(level.value, 1.0));
  const double weight = noise * noise / (bend * bend);
  for (int k = 0; k < points; ++k) {
    matrix(k, k) += 1e-9 * weight;
    if (k == 0 || k + 1 == points) continue;
    const std::array<double, 3> difference{1, -2, 1};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c <= r; ++c)
        matrix(k - 1 + r, k - 1 + c) +=
            weight * difference[static_cast<std::size_t>(r)] * difference[static_cast<std::size_t>(c)];
  }
  LevelSolution out;
  out.conductance = numerics::solve_symmetric(matrix, right);
  each_sample(strokes, *first, *last, stroke_m, lag_s, [&](const auto& shares, double flow) {
    const double deviation = flow - shares.dot(out.conductance);
    out.sum_of_squares += deviation * deviation;
    out.largest = std::max(out.largest, std::abs(deviation));
    ++out.samples;
  });
  return out;
}

/// The lag that leaves least at the highest level, by golden section.
double find_lag_s(const MeteredStrokes& strokes, const Level& level, double stroke_m) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  const auto left = [&](double lag_s) { return solve_level(strokes, level, stroke_m, lag_s).sum_of_squares; };
  double from = 0, to = longest_lag_s;
  double a = to - golden * (to - from), b = from + golden * (to - from);
  double left_a = left(a), left_b = left(b);
  for (int round = 0; round < 9; ++round) {
    if (left_a < left_b) {
      to = b, b = a, left_b = left_a;
      a = to - golden * (to - from), left_a = left(a);
    } else {
      from = a, a = b, left_a = left_b;
      b = from + golden * (to - from), left_b = left(b);
    }
  }
  return 0.5 * (from + to);
}

}  // namespace

ConductanceFit conductance_of(const AxialForceFit& measured) {
  ConductanceFit out{measured.oil_temperature_K, 0, measured.flow_residual.rms(), measured.flow_residual.largest, {}};
  for (const model::AxialForceLoop& loop : measured.loops) {
    const auto& pressure_Pa = loop.pressure_difference_Pa;
    const auto nodes = static_cast<double>(pressure_Pa.size());
    ConductanceLevel& level = out.levels.emplace_back();
    level.pressure_difference_Pa = std::accumulate(pressure_Pa.begin(), pressure_Pa.end(), 0.0) / nodes;
    for (int k = 0; k < points; ++k) {
      const auto at = static_cast<std::size_t>(std::lround((nodes - 1) * k / (points - 1)));
      level.conductance_m3_per_s_per_rootPa.push_back(std::max(0.0, loop.flow_m3_per_s[at]) /
                                                      std::sqrt(std::max(1.0, pressure_Pa[at])));
    }
  }
  return out;
}

ConductanceFit fit_conductance(const recording::Recording& recording, double stroke_m) {
  HeldPressures held = find_held_pressures(recording, stroke_m);
  const auto position_m = recording[Channel::position];
  MeteredStrokes strokes{recording[Channel::time],
                         recording[Channel::flow_reference],
                         {position_m.begin(), position_m.end()},
                         std::move(held.pressure_difference_Pa)};
  const double closed_m = closed_reading_m(position_m, stroke_m);
  for (double& x : strokes.position_m) x -= closed_m;
  ConductanceFit out{mean_oil_temperature_K(recording), find_lag_s(strokes, held.levels.back(), stroke_m), 0, 0, {}};
  double sum_of_squares = 0;
  std::size_t samples = 0;
  for (const Level& level : held.levels) {
    const LevelSolution solution = solve_level(strokes, level, stroke_m, out.meter_lag_s);
    sum_of_squares += solution.sum_of_squares;
    samples += solution.samples;
    out.largest_m3_per_s = std::max(out.largest_m3_per_s, solution.largest);
    ConductanceLevel each{level.value, {}};
    for (const double conductance : solution.conductance)
      each.conductance_m3_per_s_per_rootPa.push_back(std::max(0.0, conductance));
    out.levels.push_back(std::move(each));
  }
  out.residual_m3_per_s = std::sqrt(sum_of_squares / static_cast<double>(std::max<std::size_t>(1, samples)));
  return out;
}

}  // namespace spoolflow::calibration

#include "spoolflow/calibration/type/plan_minute.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/numerics/covariance.hpp"
#include "spoolflow/calibration/type/type_model.hpp"
#include "spoolflow/calibration/type/unit_effects.hpp"
#include "spoolflow/calibration/type/unit_evidence.hpp"

namespace spoolflow::calibration {
namespace {

constexpr std::array<double, 9> tried_pressure_shares{0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1};
/// No faster: friction falls with speed, and the maps have that of slow strokes.
constexpr std::array<double, 4> rates_per_s{0.06, 0.08, 0.12, 0.16};
/// So much of a flow [share] is unknown where nothing but the range of pressures is known: one standard deviation.
constexpr double flow_of_unknown_pressure = 0.3;
/// The deviations, the flow meter's gain, and what the maps are wrong by: see UnitUnknowns.
constexpr Eigen::Index gain = deviating, friction_left = deviating + 1, friction_tilt = deviating + 2,
                       tilt = deviating + 3, searched = deviating + 4;

/// What each direction of motion makes of the force rows: the spool slides one way, loop and friction hinder it.
Eigen::MatrixXd force_rows(const EffectSlopes& slopes, double friction_ratio, int direction) {
  return slopes.force_N - direction * (slopes.loop_N + friction_ratio * slopes.friction_N);
}

double stroke_s(double rate_per_s) {
  return 2 / rate_per_s + planned_hold_s + 2 * planned_pause_s;
}

class Planner {
 public:
  Planner(const model::Model& type, const KnownDeviations& known) : type_(type), known_(known) {
    deviation_ = known.covariance.diagonal().cwiseSqrt();
    prior_ = Eigen::MatrixXd::Zero(searched, searched);
    prior_.topLeftCorner(deviating, deviating) = inverse_of_covariance(known.covariance);
    prior_(gain, gain) = 1 / (meter_gain_uncertainty * meter_gain_uncertainty);
    prior_(friction_left, friction_left) = 1 / (unloaded_friction_uncertainty_N * unloaded_friction_uncertainty_N);
    prior_(friction_tilt, friction_tilt) = 1 / (friction_tilt_uncertainty_N * friction_tilt_uncertainty_N);
    prior_(tilt, tilt) = 1 / (conductance_tilt_uncertainty * conductance_tilt_uncertainty);
    find_flow_slopes();
  }

  /// Standard uncertainty of the flow where so much is known, as a share of the rated flow.
  [[nodiscard]] double left_share(const Eigen::MatrixXd& precision) const {
    const Eigen::MatrixXd covariance = left_of(precision);
    const Eigen::VectorXd variance = (flow_slopes_ * covariance).cwiseProduct(flow_slopes_).rowwise().sum();
    double sum = 0;
    for (Eigen::Index k = 0; k < variance.size(); ++k)
      sum += variance(k) * most_variance_(k) / (variance(k) + most_variance_(k));
    return std::sqrt(sum / static_cast<double>(variance.size())) / type_.valve.rated_flow_m3_per_s;
  }

  [[nodiscard]] double before_share() const { return left_share(prior_); }

  /// The best strokes of that rate and what they leave.
  [[nodiscard]] PlannedMinute best_of(double rate_per_s, std::size_t strokes) const {
    std::vector<Eigen::MatrixXd> information;
    for (const double share : tried_pressure_shares) information.push_back(information_of(rate_per_s, share));
    std::vector<std::size_t> chosen;
    Eigen::MatrixXd precision = prior_ + at_rest();
    for (std::size_t k = 0; k < strokes; ++k) {
      chosen.push_back(best_level(precision, information));
      precision += information[chosen.back()];
    }
    for (bool better = true; better;) {  // exchange one after the other until none helps
      better = false;
      for (std::size_t& level : chosen) {
        const Eigen::MatrixXd without = precision - information[level];
        const std::size_t other = best_level(without, information);
        if (!(left_share(without + information[other]) < (1 - 1e-6) * left_share(precision))) continue;
        precision = without + information[other];
        level = other;
        better = true;
      }
    }
    std::ranges::sort(chosen);
    PlannedMinute out{rate_per_s, {}, before_share(), left_share(precision), {known_.mean, left_of(precision)}};
    const double highest_Pa = unit().edge.highest_pressure_difference_Pa();
    for (const std::size_t level : chosen) out.pressures_Pa.push_back(tried_pressure_shares[level] * highest_Pa);
    return out;
  }

 private:
  [[nodiscard]] const sensor::ObserverParameters<double>& unit() const { return type_.observer->parameters; }

  [[nodiscard]] static Eigen::MatrixXd left_of(const Eigen::MatrixXd& precision) {
    return inverse_of_covariance(precision).topLeftCorner(deviating, deviating);
  }

  [[nodiscard]] std::size_t best_level(const Eigen::MatrixXd& before,
                                       const std::vector<Eigen::MatrixXd>& information) const {
    std::size_t out = 0;
    double least = INFINITY;
    for (std::size_t k = 0; k < information.size(); ++k) {
      const double left = left_share(before + information[k]);
      if (left < least) out = k;
      least = std::min(least, left);
    }
    return out;
  }

  /// By what the sensor's flow is off for each deviation that is off: it takes force for pressure difference.
  void find_flow_slopes() {
    const std::vector<OperatingPoint> points = operating_points(unit());
    const EffectSlopes slopes = effect_slopes(unit(), points, deviation_);
    const auto count = static_cast<Eigen::Index>(points.size());
    flow_slopes_.resize(2 * count, deviating);
    most_variance_.resize(2 * count);
    for (const int direction : {1, -1}) {
      const Eigen::MatrixXd force_N = force_rows(slopes, unit().friction.operation_ratio, direction);
      for (Eigen::Index p = 0; p < count; ++p) {
        const OperatingPoint& point = points[p];
        const double conductance = slopes.here[p].conductance;
        const double root = std::sqrt(point.pressure_Pa), flow_m3_per_s = conductance * root;
        const double per_Pa_N = unit()
                                    .edge.at(unit().edge.temperature_K.at(1), point.pressure_Pa, point.position_m)
                                    .flow_force_per_pressure_N_Pa;
        const Eigen::Index row = direction > 0 ? p : count + p;
        flow_slopes_.row(row) =
            flow_m3_per_s * 0.5 / (per_Pa_N * point.pressure_Pa) * force_N.row(p) + root * slopes.conductance.row(p);
        most_variance_(row) = std::pow(flow_of_unknown_pressure * flow_m3_per_s, 2) + 1e-20;
      }
    }
  }

  /// Position at the closed end, and the coil's resistance over whole strokes.
  [[nodiscard]] Eigen::MatrixXd at_rest() const {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(searched, searched);
    const std::size_t zero = at(Variation::position_zero), resistance = at(Variation::resistance);
    out(zero, zero) = 1 / (closed_reading_uncertainty_m * closed_reading_uncertainty_m);
    out(resistance, resistance) = 1 / (resistance_uncertainty_share * resistance_uncertainty_share);
    return out;
  }

  /// Rows of both ways, as UnitEvidence makes them.
  [[nodiscard]] Eigen::MatrixXd information_of(double rate_per_s, double pressure_share) const {
    const double stroke_m = type_.valve.stroke_m, speed_m_per_s = rate_per_s * stroke_m;
    const double apart_m = std::min(row_travel_m, row_time_s * speed_m_per_s);
    const double pressure_Pa = pressure_share * unit().edge.highest_pressure_difference_Pa();
    std::vector<OperatingPoint> points;
    for (double position_m = end_share * stroke_m; position_m < (1 - end_share) * stroke_m; position_m += apart_m)
      points.push_back(balanced_point(unit(), position_m, pressure_Pa));
    const EffectSlopes slopes = effect_slopes(unit(), points, deviation_);
    const double force_N = force_row_uncertainty_N(type_), flow_m3_per_s = flow_row_uncertainty_m3_per_s(type_);
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(searched, searched);
    for (const int direction : {1, -1}) {
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(points.size(), searched);
      rows.leftCols(deviating) = force_rows(slopes, unit().friction.operation_ratio, direction);
      for (std::size_t p = 0; p < points.size(); ++p) {
        rows(p, friction_tilt) = -direction * (2 * points[p].position_m / stroke_m - 1);
      }
      if (pressure_share < unloaded_share) rows.col(friction_left).setConstant(-direction);
      if (speed_m_per_s < fastest_sliding_m_per_s) out += rows.transpose() * rows / (force_N * force_N);
      if (!(speed_m_per_s < fastest_metered_m_per_s) || pressure_Pa == 0) continue;
      for (std::size_t p = 0; p < points.size(); ++p) {
        if (points[p].position_m < unit().closed_below_m) continue;
        Eigen::VectorXd row = Eigen::VectorXd::Zero(searched);
        row.head(deviating) = std::sqrt(pressure_Pa) * slopes.conductance.row(p);
        row(gain) = std::sqrt(pressure_Pa) * slopes.here[p].conductance;
        row(tilt) = row(gain) * (2 * points[p].position_m / stroke_m - 1);
        out += row * row.transpose() / (flow_m3_per_s * flow_m3_per_s);
      }
    }
    return out;
  }

  const model::Model& type_;
  const KnownDeviations& known_;
  Eigen::VectorXd deviation_;
  Eigen::MatrixXd prior_;
  Eigen::MatrixXd flow_slopes_;
  Eigen::VectorXd most_variance_;
};

}  // namespace

std::vector<PlannedCorner> PlannedMinute::corners() const {
  std::vector<PlannedCorner> out;
  double time_s = 0;
  const std::array<double, 4> lasts_s{planned_pause_s, 1 / rate_per_s, planned_hold_s, 1 / rate_per_s};
  const std::array<double, 4> begins{0, 0, 1, 1};
  const std::vector<double> peaks = both_ways ? std::vector<double>{1, -1} : std::vector<double>{1};
  for (const double pressure_Pa : pressures_Pa) {
    for (const double peak : peaks) {
      for (std::size_t k = 0; k < lasts_s.size(); ++k) {
        out.push_back({time_s, begins[k] == 0 ? 0 : peak, pressure_Pa});
        time_s += lasts_s[k];
      }
      out.push_back({time_s, 0, pressure_Pa});
      time_s += planned_pause_s;
    }
  }
  if (!pressures_Pa.empty()) out.push_back({time_s, 0, pressures_Pa.back()});
  return out;
}

PlannedMinute plan_minute(const model::Model& type, const std::string& file, double seconds) {
  if (type.whole()) {
    PlannedMinute out = plan_minute(model::of_direction(type, "b"), file, seconds / 2);
    out.both_ways = true;
    return out;
  }
  const KnownDeviations known = known_of_type(type, file);
  const Planner planner(type, known);
  PlannedMinute out{0, {}, planner.before_share(), INFINITY, known};
  for (const double rate_per_s : rates_per_s) {
    const auto strokes = static_cast<std::size_t>(std::max(0.0, seconds / stroke_s(rate_per_s)));
    if (strokes == 0) continue;
    PlannedMinute tried = planner.best_of(rate_per_s, strokes);
    if (tried.after_share < out.after_share) out = std::move(tried);
  }
  if (out.pressures_Pa.empty()) {
    throw CalibrationError(
        fmt::format("{:g} s are too short: one stroke of the valve takes {:.1f} s; give at least so much", seconds,
                    stroke_s(rates_per_s.back())));
  }
  return out;
}

model::Model planned_unit(const model::Model& type, const PlannedMinute& minute) {
  model::Model out = type;
  set_spread(out, type.type->environment, minute.after);
  return out;
}

}  // namespace spoolflow::calibration

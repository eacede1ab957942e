#include "spoolflow/calibration/operation/operation_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spoolflow/calibration/numerics/fitted_parameters.hpp"
#include "spoolflow/calibration/operation/operation_score.hpp"
#include "spoolflow/numerics/equations/symmetric_equations.hpp"
#include "spoolflow/parallel/for_each.hpp"

namespace spoolflow::calibration {

namespace {

/// Whether the pressure difference that the reference shows has changed since the spool last slid, which no force at
/// rest shows.
class MovedPressure {
 public:
  explicit MovedPressure(double least_conductance) : least_conductance_(least_conductance) {}
  /// False before the first sliding of a recording.
  bool since_sliding(const ReplayedSample& sample) {
    if (sample.time_s < last_s_) slid_at_Pa_ = std::nan("");
    last_s_ = sample.time_s;
    if (sample.shown_conductance < least_conductance_) return false;
    const double root = sample.reference_m3_per_s / sample.shown_conductance, shown_Pa = root * root;
    if (sensor::slides(sample.state.position.motion)) slid_at_Pa_ = shown_Pa;
    return std::abs(shown_Pa - slid_at_Pa_) > held_share * slid_at_Pa_;
  }

 private:
  static constexpr double held_share = 0.1;  ///< meter and edge leave no less open of a held one
  double least_conductance_;
  double last_s_ = std::numeric_limits<double>::infinity();
  double slid_at_Pa_ = std::nan("");
};

/// What the samples at rest show, the edge open.
struct AtRest {
  double sum_of_squares = 0;  ///< of the flow's error over what one standard deviation of the forces makes of it
  std::size_t samples = 0;
  std::size_t moved = 0;  ///< of these, where the pressure difference has moved since the spool slid
};

AtRest at_rest(const sensor::ObserverParameters<double>& parameters, const std::vector<OperatingRun>& runs) {
  constexpr double least_opening_share = 0.05;
  MovedPressure moved(least_opening_share * sensor::most_flow(parameters) /
                      std::sqrt(parameters.highest_pressure_difference_Pa()));
  AtRest out;
  replay(parameters, runs, [&](const ReplayedSample& sample) {
    const auto& [valve, state, time_s, position_m, reference_m3_per_s, shown, shown_conductance] = sample;
    const bool has_moved = moved.since_sliding(sample);
    if (state.position.motion != sensor::Motion::rest || sensor::has(state.last.status, sensor::Status::closed)) return;
    const double pressure_Pa = std::max(1e5, state.pressure.pressure_difference_Pa);
    const sensor::EdgePoint<double> edge = valve.edge.at(state.oil.temperature_K, pressure_Pa, position_m);
    const double flow_per_pressure = edge.conductance / (2 * std::sqrt(pressure_Pa));
    const double deviation_m3_per_s =
        flow_per_pressure * sensor::pressure_deviation_Pa(edge, state.force_errors.noise_N);
    const double error =
        (reference_m3_per_s - shown.flow) / std::hypot(deviation_m3_per_s, 2 * parameters.band.flow_residual_m3_per_s);
    out.sum_of_squares += error * error;
    ++out.samples;
    if (has_moved) ++out.moved;
  });
  return out;
}

/// The smallest ratio, up to `most`, whose band holds `needed_coverage` of the reference.
double covering_ratio(sensor::ObserverParameters<double> parameters, const std::vector<OperatingRun>& runs,
                      double most) {
  double least = least_force_error_ratio;
  constexpr double resolution = 1.05;
  while (most > resolution * least) {
    const double middle = std::sqrt(least * most);
    scale_band(parameters, middle);
    (replay_whole(parameters, runs).coverage() >= needed_coverage ? most : least) = middle;
  }
  return most;
}

}  // namespace

double force_error_ratio(const sensor::ObserverParameters<double>& parameters, const std::vector<OperatingRun>& runs) {
  const AtRest found = at_rest(parameters, runs);
  if (found.samples == 0) return assumed_force_error_ratio;
  const auto samples = static_cast<double>(found.samples);
  const double ratio = std::max(least_force_error_ratio, std::sqrt(found.sum_of_squares / samples));
  return static_cast<double>(found.moved) > restless_share * samples ? covering_ratio(parameters, runs, ratio) : ratio;
}

void scale_band(sensor::ObserverParameters<double>& parameters, double force_error_ratio) {
  // One proportion for all valves, found on the runs of five of them together (docs/accuracy.md).
  constexpr double sliding = 1.08;
  constexpr double resting = 1.43;
  constexpr double tolerance = 0.55;
  // The ratio is found at rest, where a larger tolerance of friction than valves have hides errors of forces.
  const double hidden = std::max(1.0, parameters.friction.tolerance_N / largest_usual_tolerance_N);
  parameters.band.force_share = sliding * hidden * force_error_ratio;
  parameters.band.rest_share = resting * hidden * force_error_ratio;
  parameters.band.tolerance_N = tolerance * force_error_ratio * parameters.friction.tolerance_N;
}

namespace {

constexpr double stretch_s = 2;  // friction in one is hardly that in the next
constexpr double log_step = 0.1;
const double pulled_to_deviation = std::log(2.0);  // of a valve's parameters from those assumed: a factor of two

/// The score as a sum over stretches: the RMS error stands for its linear part about `rms_m3_per_s`, so that the sum
/// has the score's slope.
Eigen::VectorXd scores(const std::vector<OperationOutcome>& stretches, double rms_m3_per_s,
                       double full_scale_m3_per_s) {
  const auto samples = static_cast<double>(together(stretches).error.samples);
  Eigen::VectorXd out(static_cast<Eigen::Index>(stretches.size()));
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    const OperationOutcome& each = stretches[static_cast<std::size_t>(k)];
    out(k) = (each.interval_score + weight_of_error * each.error.sum_of_squares / (2 * rms_m3_per_s)) /
             (samples * full_scale_m3_per_s);
  }
  return out;
}

/// Inverse of a curvature that differences may have made too flat somewhere: the pull is added until it is definite.
Eigen::MatrixXd inverse_of(Eigen::MatrixXd curvature, double pull) {
  const Eigen::Index unknowns = curvature.rows();
  if (!curvature.allFinite() || !(pull > 0)) return Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (double added = pull;; added *= 2) {
    if (std::optional<Eigen::MatrixXd> inverse = numerics::inverse_of_definite(curvature)) return *inverse;
    curvature.diagonal().array() += added;
  }
}

/// Curvature of a score over the parameters' logarithms about its minimum.
struct Curvature {
  Eigen::MatrixXd slopes;     ///< of each stretch
  Eigen::MatrixXd curvature;  ///< of their sum
};

/// Scores of the stretches with one parameter turned, or with two.
struct Turned {
  std::size_t a, b;
  double log_a, log_b;
  Eigen::VectorXd scores;
};

/// By differences. `turn` finds the scores of each.
template <class Turn>
Curvature curvature_about(const Eigen::VectorXd& middle, const std::vector<Eigen::Index>& free, double pull,
                          const Turn& turn) {
  const auto index = [&](Eigen::Index r) { return static_cast<std::size_t>(free[static_cast<std::size_t>(r)]); };
  const auto count = static_cast<Eigen::Index>(free.size());
  std::vector<Turned> turned;
  for (Eigen::Index r = 0; r < count; ++r) {
    for (const double step : {log_step, -log_step}) turned.push_back({index(r), index(r), step, 0, {}});
    for (Eigen::Index c = 0; c < r; ++c) turned.push_back({index(r), index(c), log_step, log_step, {}});
  }
  parallel::for_each(turned.size(), parallel::cores(), [&](std::size_t k) { turn(turned[k]); });

  Curvature out{Eigen::MatrixXd(middle.size(), count), Eigen::MatrixXd(count, count)};
  Eigen::VectorXd above(count);
  auto next = turned.cbegin();
  for (Eigen::Index r = 0; r < count; ++r) {
    const Eigen::VectorXd &up = (next++)->scores, &down = (next++)->scores;
    out.slopes.col(r) = (up - down) / (2 * log_step);
    above(r) = up.sum();
    out.curvature(r, r) = (up.sum() + down.sum() - 2 * middle.sum()) / (log_step * log_step) + 2 * pull;
    for (Eigen::Index c = 0; c < r; ++c) {
      const double both = (next++)->scores.sum();
      out.curvature(r, c) = out.curvature(c, r) = (both - above(r) - above(c) + middle.sum()) / (log_step * log_step);
    }
  }
  return out;
}

/// Huber's sandwich: how much the slope differs between stretches, between inverse curvatures. Where the pull holds a
/// parameter, it is off by what the valve's differs from the one pulled to.
Eigen::MatrixXd covariance_from(Curvature score, double pull) {
  score.slopes.rowwise() -= score.slopes.colwise().mean();
  const double stretches = static_cast<double>(score.slopes.rows());
  const Eigen::MatrixXd scatter =
      stretches / std::max(1.0, stretches - 1) * score.slopes.transpose().lazyProduct(score.slopes);
  const Eigen::MatrixXd inverse = inverse_of(std::move(score.curvature), 2 * pull);
  const Eigen::MatrixXd information =
      scatter + std::pow(2 * pull * pulled_to_deviation, 2) * Eigen::MatrixXd::Identity(scatter.rows(), scatter.cols());
  return inverse.lazyProduct(information).eval().lazyProduct(inverse);
}

}  // namespace

model::Fit known_of_operation(const std::vector<OperationParameter>& fitted, const OperationTrial& trial,
                              double full_scale_m3_per_s, double pull) {
  std::vector<std::string> names;
  std::vector<double> values;
  std::vector<Eigen::Index> free;
  OperationTrial found = trial;
  for (const OperationParameter& parameter : fitted) {
    const double value = parameter.in(found);
    if (value > 1.001 * parameter.lowest && value < 0.999 * parameter.highest)
      free.push_back(static_cast<Eigen::Index>(names.size()));
    names.emplace_back(parameter.name);
    values.push_back(value);
  }
  const std::vector<OperationOutcome> here = replay_stretches(found.parameters(), found.runs(), stretch_s);
  const double rms_m3_per_s = std::max(1e-9 * full_scale_m3_per_s, together(here).error.rms());
  const auto turn = [&](Turned& turned) {
    OperationTrial each = trial;
    fitted[turned.a].in(each) *= std::exp(turned.log_a);
    fitted[turned.b].in(each) *= std::exp(turned.log_b);
    turned.scores =
        scores(replay_stretches(each.parameters(), each.runs(), stretch_s), rms_m3_per_s, full_scale_m3_per_s);
  };
  const Eigen::MatrixXd on_log_scale =
      covariance_from(curvature_about(scores(here, rms_m3_per_s, full_scale_m3_per_s), free, pull, turn), pull);
  const Eigen::Map<const Eigen::VectorXd> scale(values.data(), static_cast<Eigen::Index>(values.size()));
  const Eigen::MatrixXd covariance =
      scale.asDiagonal() * spread_over(scale.size(), free, on_log_scale) * scale.asDiagonal();
  return known_from(fit_of_operation, names, values, covariance);
}

}  // namespace spoolflow::calibration

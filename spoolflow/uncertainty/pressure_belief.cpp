#include "spoolflow/uncertainty/pressure_belief.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "spoolflow/uncertainty/distribution.hpp"

namespace spoolflow::uncertainty {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// value times standard normal density; zero at infinity.
double first_moment(double value) {
  return std::isfinite(value) ? value * std::exp(-0.5 * value * value) / std::sqrt(2 * std::numbers::pi) : 0;
}

/// Mean square of a standard normal number between -`below` and `above`, which holds `share` of it.
double mean_square_within(double below, double above, double share) {
  constexpr double narrow = 1e-3;  // the density is even there
  if (share > narrow) return std::max(0.0, 1 - (first_moment(above) + first_moment(below)) / share);
  return below + above > 0 ? (above * above * above + below * below * below) / (3 * (below + above)) : 0;
}

}  // namespace

PressureBelief::PressureBelief(const Parts& parts) : parts_(parts) {
  const double deviation_Pa = parts_.deviation_Pa;
  if (!(deviation_Pa > 0)) return;
  parts_.below_Pa = std::max(0.0, parts_.below_Pa);
  parts_.above_Pa = std::max(0.0, parts_.above_Pa);
  const double below = parts_.below_Pa / deviation_Pa;
  const double above = parts_.above_Pa / deviation_Pa;
  below_share_ = normal_share_below(-below);
  above_share_ = normal_share_below(above);
  const double within = mean_square_within(below, above, above_share_ - below_share_);
  // Where the bounds take nothing away, it does not matter how uncertain they are.
  const double within_Pa = deviation_Pa * std::sqrt(within);
  standard_uncertainty_Pa_ =
      std::min(deviation_Pa, std::hypot(within_Pa, parts_.bounds_Pa * std::max(0.0, 1 - within)));
  widening_ = within_Pa > 0 ? standard_uncertainty_Pa_ / within_Pa : 1;
}

double PressureBelief::flow_error_of_m3_per_s(double error_Pa) const {
  const double truth_Pa = std::clamp(parts_.pressure_difference_Pa - error_Pa, 0.0, parts_.highest_Pa);
  return parts_.conductance * (std::sqrt(parts_.pressure_difference_Pa) - std::sqrt(truth_Pa));
}

double PressureBelief::flow_uncertainty_m3_per_s() const {
  return 0.5 * (flow_error_of_m3_per_s(standard_uncertainty_Pa_) - flow_error_of_m3_per_s(-standard_uncertainty_Pa_));
}

double PressureBelief::flow_error_m3_per_s(double normal) const {
  if (!(parts_.deviation_Pa > 0) || normal == 0) return 0;
  double error_Pa = parts_.deviation_Pa * normal;
  if (std::isfinite(parts_.below_Pa) || std::isfinite(parts_.above_Pa)) {
    const double share = below_share_ + normal_share_below(normal) * (above_share_ - below_share_);
    constexpr double least = 1e-12;
    error_Pa = std::clamp(parts_.deviation_Pa * normal_quantile(std::clamp(share, least, 1 - least)), -parts_.below_Pa,
                          parts_.above_Pa);
  }
  return flow_error_of_m3_per_s(widening_ * error_Pa);
}

PressureBelief pressure_belief(const sensor::ObserverParameters<double>& valve,
                               const sensor::ObserverState<double>& state, double position_m, double step_s) {
  const sensor::Estimate<double>& answer = state.last;
  const double believed_Pa = std::max(0.0, answer.pressure_difference_Pa);
  const auto edge = valve.edge.at(state.oil.temperature_K, believed_Pa, position_m);
  const double slope_N_per_Pa = edge.flow_force_per_pressure_N_Pa;
  const double share = valve.band.coverage_factor * deviation_per_half_width(Distribution::normal);
  PressureBelief::Parts parts{
      .deviation_Pa = share * state.pressure.band_factor *
                      sensor::unobserved_change_Pa(state.pressure, valve.band.unobserved_factor),
      .below_Pa = unbounded,
      .above_Pa = unbounded,
      .pressure_difference_Pa = believed_Pa,
      .highest_Pa = valve.edge.highest_pressure_difference_Pa(),
      .conductance = std::max(0.0, edge.conductance),
  };
  if (!sensor::has(answer.status, sensor::Status::spool_at_rest)) {
    const double noise_Pa_sqrt_s =
        sensor::pressure_deviation_Pa(edge, state.force_errors.noise_N) * std::sqrt(valve.pressure.force_correlation_s);
    parts.deviation_Pa = std::sqrt(parts.deviation_Pa * parts.deviation_Pa +
                                   0.5 * valve.pressure.sliding_drift_Pa_per_sqrt_s * noise_Pa_sqrt_s);
  } else if (!sensor::has(answer.status, sensor::Status::closed)) {
    const double reach_N = sensor::presliding_half_width_N(
        valve.friction, valve.position_sensor, sensor::presliding_deadband_m(valve.position_sensor.noise_m, step_s));
    const double apparent_N = answer.magnetic_force_N - answer.spring_force_N - answer.flow_force_N;
    // The estimate's error is (friction - apparent)/slope, friction within its half-width by pre-sliding.
    parts.above_Pa = (state.friction.presliding_N + reach_N - apparent_N) / slope_N_per_Pa;
    parts.below_Pa = (apparent_N - state.friction.presliding_N + reach_N) / slope_N_per_Pa;
    parts.bounds_Pa =
        sensor::pressure_deviation_Pa(edge, sensor::bounds_deviation_N(valve.band, state.friction.rest_s));
  }
  return PressureBelief(parts);
}

}  // namespace spoolflow::uncertainty

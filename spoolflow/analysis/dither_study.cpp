#include "spoolflow/analysis/dither_study.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "spoolflow/analysis/point_analysis.hpp"
#include "spoolflow/calibration/numerics/interpolation.hpp"
#include "spoolflow/numerics/crossing.hpp"
#include "spoolflow/parallel/for_each.hpp"

namespace spoolflow::analysis {
namespace {

using Observer = sensor::ObserverParameters<double>;

constexpr int samples_a_period = 64;  // 62 us at 250 Hz: the actuator is good for 50 us and more
constexpr int periods_until_settled = 10;
constexpr int periods_until_still = 20;  // a spool that friction stops from the free mass' speed stands by then
constexpr int periods_evaluated = 2;
constexpr double mass_step_s = 1e-5;           // contacts and mass swing at 1 to 3 kHz
constexpr double sliding_drag_N_s_per_m = 22;  // of spool and armature; no bench shows it

/// -1 to 1; `turns` from 0 to 1.
double wave(DitherShape shape, double turns, double frequency_Hz) {
  if (shape == DitherShape::sine) return std::sin(2 * std::numbers::pi * turns);
  const double edge = std::min(square_edge_s * frequency_Hz, 0.5);  // of a period, about its zero
  const double from_zero = turns < 0.25 ? turns : turns < 0.75 ? 0.5 - turns : turns - 1;
  return std::clamp(2 * from_zero / edge, -1.0, 1.0);
}

sensor::Sample<double> sample_of(double time_step_s, double current_A, double position_m) {
  return {time_step_s, current_A, NAN, position_m, NAN};
}

/// The solenoid brought to a current slowly.
sensor::ActuatorEstimate<double> held(const Observer& valve, double current_A, double position_m,
                                      sensor::ActuatorState<double>& state) {
  state = {};
  return sensor::step(valve.actuator, state, sample_of(1e-3, current_A, position_m), true);
}

/// The magnetic force over a settled period.
std::vector<double> forces_over_period(const Observer& valve, const DitherPoint& point, double amplitude_A,
                                       double frequency_Hz, DitherShape shape) {
  sensor::ActuatorState<double> state;
  static_cast<void>(held(valve, point.current_A, point.point.position_m, state));
  const double step_s = 1 / (frequency_Hz * samples_a_period);
  std::vector<double> out;
  for (int k = 1; k <= samples_a_period * (periods_until_settled + periods_evaluated); ++k) {
    const double turns = static_cast<double>(k % samples_a_period) / samples_a_period;
    const double current_A = std::max(point.current_A + amplitude_A * wave(shape, turns, frequency_Hz), 0.0);
    const double force_N =
        sensor::step(valve.actuator, state, sample_of(step_s, current_A, point.point.position_m), false)
            .magnetic_force_N;
    if (k > samples_a_period * periods_until_settled) out.push_back(force_N);
  }
  return out;
}

/// Friction while the spool moves on, which the bench's slow sliding does not show.
double moving_friction_N(const DitherPoint& point, double velocity_m_per_s) {
  const double ratio = velocity_m_per_s / mixed_friction_m_per_s;
  return point.sliding_N * (moving_friction_share + (1 - moving_friction_share) / (1 + ratio * ratio));
}

/// Half of peak to peak of the mass' way under those forces. It begins in motion: where force and friction allow both,
/// rest and motion, the spool moves, since any step of pressure or set position sets it going.
double motion_m(const Observer& valve, const DitherPoint& point, const std::vector<double>& forces_N,
                double half_swing_N, double frequency_Hz) {
  const double contact_N_per_m = valve.friction.contact_stiffness_N_per_m;
  if (half_swing_N <= moving_friction_share * point.sliding_N) return half_swing_N / contact_N_per_m;
  // What the position control holds in the mean.
  const double mean_N = std::accumulate(forces_N.begin(), forces_N.end(), 0.0) / static_cast<double>(forces_N.size());
  const double mass_kg = valve.moving_mass_kg;
  const double damping_N_s_per_m = 2 * contact_damping_share * std::sqrt(contact_N_per_m * mass_kg);
  const double sample_s = 1 / (frequency_Hz * samples_a_period);
  const int steps = static_cast<int>(std::ceil(sample_s / mass_step_s));
  const double step_s = sample_s / steps;
  double v_m_per_s = half_swing_N / (mass_kg * 2 * std::numbers::pi * frequency_Hz);  // that of the free mass
  double x_m = 0, contact_m = 0, least_m = 0, most_m = 0;
  for (int k = 0; k < samples_a_period * (periods_until_still + periods_evaluated); ++k) {
    const double before_N = forces_N[static_cast<std::size_t>(k) % forces_N.size()];
    const double after_N = forces_N[static_cast<std::size_t>(k + 1) % forces_N.size()];
    if (k == samples_a_period * periods_until_still) least_m = most_m = x_m;
    for (int s = 0; s < steps; ++s) {
      const double force_N = before_N + (after_N - before_N) * s / steps - mean_N;
      const double reach_m = moving_friction_N(point, v_m_per_s) / contact_N_per_m;
      const double yielded_m = contact_m + v_m_per_s * step_s;
      contact_m = std::clamp(yielded_m, -reach_m, reach_m);
      const double drag_N = (contact_m == yielded_m ? damping_N_s_per_m : sliding_drag_N_s_per_m) * v_m_per_s;
      v_m_per_s += step_s / mass_kg *
                   (force_N - contact_N_per_m * contact_m - drag_N - std::max(point.stiffness_N_per_m, 0.0) * x_m);
      x_m += v_m_per_s * step_s;
      least_m = std::min(least_m, x_m);
      most_m = std::max(most_m, x_m);
    }
  }
  return 0.5 * (most_m - least_m);
}

/// Half the width of the flow's band where the flow force is known to `band_N`.
double flow_band_m3_per_s(const Observer& valve, const uncertainty::WorkingPoint& point, double band_N) {
  const auto edge = valve.edge.at(point.oil_temperature_K, point.pressure_difference_Pa, point.position_m);
  const double band_Pa = band_N / edge.flow_force_per_pressure_N_Pa;
  const double most_Pa = std::min(point.pressure_difference_Pa + band_Pa, valve.edge.highest_pressure_difference_Pa());
  const double least_Pa = std::max(point.pressure_difference_Pa - band_Pa, 0.0);
  return 0.5 * edge.conductance * (std::sqrt(std::max(most_Pa, point.pressure_difference_Pa)) - std::sqrt(least_Pa));
}

DitherSetting over_all_points(const DitherStudy& study, std::size_t place, double full_scale_m3_per_s) {
  DitherSetting out{0, 0, 0, false};
  for (const auto& effects : study.effects) {
    const DitherEffect& effect = effects[place];
    out.mean_band_m3_per_s += effect.band_m3_per_s / static_cast<double>(study.points.size());
    out.largest_motion_m = std::max(out.largest_motion_m, effect.motion_m);
    out.largest_ripple_m3_per_s = std::max(out.largest_ripple_m3_per_s, effect.flow_ripple_m3_per_s);
  }
  out.within_limit = out.largest_ripple_m3_per_s <= study.question.ripple_limit_share * full_scale_m3_per_s;
  return out;
}

/// Whether this amplitude and all up to the reserve above it keep the ripple's limit, over `place`; no amplitude is
/// kept whose reserve goes beyond those that were looked at.
std::vector<bool> kept_with_reserve(const DitherStudy& study) {
  std::vector<bool> out(study.settings.size(), true);
  for (std::size_t a = 0; a < study.amplitude_A.size(); ++a) {
    for (std::size_t f = 0; f < study.frequency_Hz.size(); ++f) {
      const double most_A = (1 + amplitude_reserve(study.frequency_Hz[f])) * study.amplitude_A[a];
      if (study.amplitude_A.back() < most_A) out[study.place(a, f)] = false;
      // Up to the first amplitude that has the whole reserve.
      for (std::size_t above = a; above < study.amplitude_A.size(); ++above) {
        if (!study.settings[study.place(above, f)].within_limit) out[study.place(a, f)] = false;
        if (study.amplitude_A[above] >= most_A) break;
      }
    }
  }
  return out;
}

}  // namespace

std::optional<DitherPoint> dither_point(const model::Model& model, const uncertainty::WorkingPoint& point) {
  const Observer& valve = model.observer->parameters;
  const double x_m = point.position_m;
  const auto edge = valve.edge.at(point.oil_temperature_K, point.pressure_difference_Pa, x_m);
  if (!edge.inside || !edge.temperature_inside || x_m <= valve.closed_below_m) return std::nullopt;
  const double needed_N = valve.spring.at(x_m).value + edge.flow_force_N;
  sensor::ActuatorState<double> state;
  const auto force_N = [&](double current_A) { return held(valve, current_A, x_m, state).magnetic_force_N; };
  if (force_N(0) > needed_N || force_N(valve.largest_current_A) < needed_N) return std::nullopt;
  DitherPoint out{.point = point};
  out.current_A = numerics::crossing({0, valve.largest_current_A}, needed_N, force_N);
  const auto actuator = held(valve, out.current_A, x_m, state);
  const double ratio = valve.friction.operation_ratio;
  const sensor::FrictionState<double> rested{.rest_s = stated_rest_s};
  const auto bounds =
      sensor::friction_bounds(valve.friction, rested, ratio * edge.friction_N, ratio * actuator.friction_half_width_N);
  out.sliding_N = bounds.sliding_N;
  out.sticking_N = bounds.sticking_N;
  out.maps_N = valve.band.coverage_factor * valve.band.force_share *
               std::hypot(valve.band.force_residual_N, actuator.uncertainty_N);
  const double aside_m = 0.01 * model.valve.stroke_m;
  const auto above = valve.edge.at(point.oil_temperature_K, point.pressure_difference_Pa, x_m + aside_m);
  const auto below = valve.edge.at(point.oil_temperature_K, point.pressure_difference_Pa, x_m - aside_m);
  const auto slope = [&](double high, double low) { return (high - low) / (2 * aside_m); };
  const double root = std::sqrt(point.pressure_difference_Pa);
  out.flow_m3_per_s = root * edge.conductance;
  out.flow_per_position_m2_per_s = root * slope(above.conductance, below.conductance);
  const auto& magnetic = valve.actuator.magnetic_force;
  const double magnetising_A = state.coil.magnetising_current_A;
  out.stiffness_N_per_m =
      slope(valve.spring.at(x_m + aside_m).value, valve.spring.at(x_m - aside_m).value) +
      slope(above.flow_force_N, below.flow_force_N) -
      slope(magnetic.at(magnetising_A, x_m + aside_m).value, magnetic.at(magnetising_A, x_m - aside_m).value);
  return out;
}

DitherEffect dither_effect(const model::Model& model, const DitherPoint& point, double amplitude_A, double frequency_Hz,
                           DitherShape shape) {
  const Observer& valve = model.observer->parameters;
  const std::vector<double> forces_N = forces_over_period(valve, point, amplitude_A, frequency_Hz, shape);
  const auto [lowest, highest] = std::minmax_element(forces_N.begin(), forces_N.end());
  DitherEffect out{};
  out.half_swing_N = 0.5 * (*highest - *lowest);
  const bool found = 2 * amplitude_A > sensor::least_dither_swing_share * valve.largest_current_A;
  out.frees = found && out.half_swing_N > point.sliding_N;
  // Where dither frees the spool altogether, no contact grows old, and half the swing exceeds what is left.
  const sensor::FrictionBounds<double> aged{point.sliding_N, out.frees ? point.sliding_N : point.sticking_N};
  const auto left = sensor::within_swing(aged, found ? out.half_swing_N : 0.0, 0.0);
  out.band_N = left.sticking_N + point.maps_N;
  out.band_m3_per_s = flow_band_m3_per_s(valve, point.point, out.band_N);
  out.motion_m = motion_m(valve, point, forces_N, out.half_swing_N, frequency_Hz);
  out.flow_ripple_m3_per_s = std::abs(point.flow_per_position_m2_per_s) * out.motion_m;
  return out;
}

std::size_t recommended_setting(const DitherStudy& study) {
  const std::vector<bool> kept = kept_with_reserve(study);
  const double without = study.settings.front().mean_band_m3_per_s;
  double least = without;
  for (std::size_t place = 0; place < study.settings.size(); ++place) {
    if (kept[place]) least = std::min(least, study.settings[place].mean_band_m3_per_s);
  }
  const double enough = least + small_gain_share * without;
  if (without <= enough) return 0;
  for (std::size_t a = 0; a < study.amplitude_A.size(); ++a) {
    std::optional<std::size_t> best;
    for (std::size_t f = 0; f < study.frequency_Hz.size(); ++f) {
      const std::size_t place = study.place(a, f);
      const DitherSetting& each = study.settings[place];
      if (!kept[place] || each.mean_band_m3_per_s > enough) continue;
      if (!best || each.mean_band_m3_per_s < study.settings[*best].mean_band_m3_per_s) best = place;
    }
    if (best) return *best;
  }
  return 0;
}

DitherStudy dither_study(const model::Model& model, const DitherQuestion& question, unsigned workers) {
  if (!model.observer) {
    throw model::ModelError(
        "the model has no observer, whose solenoid and friction it needs: calibrate it from a campaign with "
        "spring, solenoid_force_map, solenoid_dynamic and axial_force_map");
  }
  DitherStudy study{.question = question};
  const double largest_A = model.observer->parameters.largest_current_A;
  study.amplitude_A = calibration::equally_spaced(0, question.most_amplitude_share * largest_A, question.amplitudes);
  study.frequency_Hz =
      calibration::equally_spaced(question.lowest_frequency_Hz, question.highest_frequency_Hz, question.frequencies);
  for (const uncertainty::WorkingPoint& point : working_points(model, question.points)) {
    if (const auto held_there = dither_point(model, point)) study.points.push_back(*held_there);
  }
  if (study.points.empty()) {
    throw model::ModelError(
        "the model's maps hold none of the working points: name others in [points] of a --scenario, within the "
        "calibrated openings, pressure differences and oil temperatures");
  }
  const std::size_t places = study.amplitude_A.size() * study.frequency_Hz.size();
  study.effects.assign(study.points.size(), std::vector<DitherEffect>(places));
  parallel::for_each(study.points.size(), workers, [&](std::size_t p) {
    for (std::size_t place = 0; place < places; ++place) {
      study.effects[p][place] = dither_effect(model, study.points[p], study.amplitude_at_A(place),
                                              study.frequency_at_Hz(place), question.shape);
    }
  });
  for (std::size_t place = 0; place < places; ++place) {
    study.settings.push_back(over_all_points(study, place, model.valve.rated_flow_m3_per_s));
  }
  study.recommended = recommended_setting(study);
  return study;
}

}  // namespace spoolflow::analysis

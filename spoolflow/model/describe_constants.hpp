#pragma once
/// The sensor's constants that are the same for all valves; see parameter.hpp. Their values stand where they are used.
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::model {

template <class Visitor>
void describe_map_constants(Visitor& visitor) {
  visitor.constant({.name = "noise_cells",
                    .unit = "cells",
                    .meaning = "how far beyond the end of an axis is still noise and no extrapolation"},
                   sensor::noise_cells);
  visitor.constant({.name = "wild_cells", .unit = "cells", .meaning = "what is this far from an axis was not measured"},
                   sensor::wild_cells<double>);
  visitor.constant({.name = "least_force_per_pressure_N_Pa",
                    .unit = "N/Pa",
                    .meaning = "no less is taken for the slope of the flow force over the pressure difference"},
                   sensor::least_force_per_pressure_N_Pa);
}

template <class Visitor>
void describe_coil_constants(Visitor& visitor) {
  visitor.constant(
      {.name = "shortest_step_s", .unit = "s", .meaning = "a step of time is taken for no shorter by the coil"},
      sensor::shortest_step_s);
  visitor.constant({.name = "slow_magnetisation_s",
                    .unit = "s",
                    .meaning = "in which the coil is taken to have been brought to its first current"},
                   sensor::slow_magnetisation_s);
  visitor.constant(
      {.name = "flux_rate_error_share",
       .unit = "1",
       .meaning = "share of the flux rate that its model may be wrong by, where the coil's resistance is followed"},
      sensor::flux_rate_error_share);
  visitor.constant({.name = "least_voltage_variance_V2s",
                    .unit = "V2 s",
                    .meaning = "variance density of the voltage that is always assumed"},
                   sensor::least_voltage_variance_V2s);
  visitor.constant({.name = "coldest_resistance_ratio",
                    .unit = "1",
                    .meaning = "least resistance over the calibrated one that copper can have"},
                   sensor::coldest_resistance_ratio);
  visitor.constant({.name = "warmest_resistance_ratio",
                    .unit = "1",
                    .meaning = "largest resistance over the calibrated one that copper can have"},
                   sensor::warmest_resistance_ratio);
  visitor.constant(
      {.name = "known_resistance_share",
       .unit = "1",
       .meaning = "how well the resistance must be known, as a share of it, before it is called implausible"},
      sensor::known_resistance_share);
}

template <class Visitor>
void describe_position_constants(Visitor& visitor) {
  visitor.constant(
      {.name = "block_length_s", .unit = "s", .meaning = "length of the blocks over which the position is averaged"},
      sensor::block_length_s);
  visitor.constant(
      {.name = "short_window_deviations",
       .unit = "1",
       .meaning = "standard deviations of the noise beyond which short windows must travel for the spool to slide"},
      sensor::short_window_deviations);
  visitor.constant(
      {.name = "long_window_deviations", .unit = "1", .meaning = "the same of long windows, for a spool that creeps"},
      sensor::long_window_deviations);
  visitor.constant({.name = "even_travel_ratio",
                    .unit = "1",
                    .meaning = "windows travel evenly where the longest is no more than so many times the shortest"},
                   sensor::even_travel_ratio);
  visitor.constant({.name = "slip_speed_m_per_s", .unit = "m/s", .meaning = "a slip is faster than this"},
                   sensor::slip_speed_m_per_s);
  visitor.constant(
      {.name = "slip_deviations", .unit = "1", .meaning = "standard deviations of the noise beyond which a slip moves"},
      sensor::slip_deviations);
  visitor.constant(
      {.name = "slip_settling_s", .unit = "s", .meaning = "how long friction and inertia are in motion after a slip"},
      sensor::slip_settling_s);
  visitor.constant(
      {.name = "credible_jump_deviations",
       .unit = "1",
       .meaning = "standard deviations of the noise up to which a change of the position signal is credible"},
      sensor::credible_jump_deviations);
  visitor.constant({.name = "credible_jump_m", .unit = "m", .meaning = "and so much more"}, sensor::credible_jump_m);
  visitor.constant({.name = "longest_position_fault_s",
                    .unit = "s",
                    .meaning = "a jump of the position signal that lasts longer is believed"},
                   sensor::longest_position_fault_s);
  visitor.constant(
      {.name = "direction_only_m", .unit = "m", .meaning = "size of a travel that tells a direction and nothing else"},
      sensor::direction_only_m);
}

template <class Visitor>
void describe_friction_constants(Visitor& visitor) {
  visitor.constant({.name = "gauge_smoothing_s",
                    .unit = "s",
                    .meaning = "smoothing of the position that the gauge of pre-sliding reads"},
                   sensor::gauge_smoothing_s);
  visitor.constant(
      {.name = "gauge_slack_deviations",
       .unit = "1",
       .meaning = "standard deviations of the smoothed position's noise that the gauge takes for no motion"},
      sensor::gauge_slack_deviations);
  visitor.constant({.name = "least_stiffness_share",
                    .unit = "1",
                    .meaning = "what is left of the contact's stiffness at the limit of sticking"},
                   sensor::least_stiffness_share);
  visitor.constant(
      {.name = "sticking_limit_deviations",
       .unit = "1",
       .meaning = "standard deviations of the gauge by which friction at rest may exceed the sticking limit"},
      sensor::sticking_limit_deviations);
  visitor.constant({.name = "least_rest_s", .unit = "s", .meaning = "a time at rest divides by no less"},
                   sensor::least_rest_s);
  visitor.constant(
      {.name = "breakaway_delay_s", .unit = "s", .meaning = "how much later a break-away shows in the position"},
      sensor::breakaway_delay_s);
  visitor.constant({.name = "shortest_rest_s", .unit = "s", .meaning = "a spool breaks away only after so long a rest"},
                   sensor::shortest_rest_s);
}

template <class Visitor>
void describe_pressure_constants(Visitor& visitor) {
  visitor.constant({.name = "first_pressure_share",
                    .unit = "1",
                    .meaning = "belief before the first sample, as a share of the highest pressure difference"},
                   sensor::first_pressure_share);
  visitor.constant(
      {.name = "first_deviation_share", .unit = "1", .meaning = "its standard deviation, as a share of the same"},
      sensor::first_deviation_share);
  visitor.constant({.name = "most_deviation_share",
                    .unit = "1",
                    .meaning = "share of the same up to which the standard deviation grows by drift"},
                   sensor::most_deviation_share);
  visitor.constant({.name = "innovation_averaging_s",
                    .unit = "s",
                    .meaning = "sliding over which normalised innovations squared are averaged"},
                   sensor::innovation_averaging_s);
  visitor.constant({.name = "usual_innovation_squared",
                    .unit = "1",
                    .meaning = "their average where the band is as wide as its parts tell"},
                   sensor::usual_innovation_squared);
  visitor.constant({.name = "innovation_gate",
                    .unit = "1",
                    .meaning = "innovations beyond so many standard deviations open the variance"},
                   sensor::innovation_gate);
  visitor.constant({.name = "gate_opening_s", .unit = "s", .meaning = "the pace of that"}, sensor::gate_opening_s);
  visitor.constant(
      {.name = "least_friction_ratio", .unit = "1", .meaning = "least friction in operation over that on the bench"},
      sensor::least_friction_ratio);
  visitor.constant(
      {.name = "most_friction_ratio", .unit = "1", .meaning = "largest friction in operation over that on the bench"},
      sensor::most_friction_ratio);
  visitor.constant({.name = "least_slope_share",
                    .unit = "1",
                    .meaning = "least share of the flow force's slope that friction leaves when the spool closes"},
                   sensor::least_slope_share);
  visitor.constant({.name = "seen_deviation_share",
                    .unit = "1",
                    .meaning = "the pressure difference counts as seen where it is known to this share of what the "
                               "forces' noise makes of it"},
                   sensor::seen_deviation_share);
  visitor.constant({.name = "process_noise_rise",
                    .unit = "1",
                    .meaning = "share by which the process noise follows an observed change that is more than thought"},
                   sensor::process_noise_rise);
  visitor.constant({.name = "process_noise_fall", .unit = "1", .meaning = "the same of one that is less"},
                   sensor::process_noise_fall);
  visitor.constant({.name = "least_unobserved_variance_Pa2",
                    .unit = "Pa2",
                    .meaning = "the variance of unobserved changes falls no lower"},
                   sensor::least_unobserved_variance_Pa2);
  visitor.constant(
      {.name = "most_variance_Pa2",
       .unit = "Pa2",
       .meaning = "a variance of the pressure difference that reaches this is none: the belief begins anew"},
      sensor::most_variance_Pa2);
}

template <class Visitor>
void describe_answer_constants(Visitor& visitor) {
  visitor.constant({.name = "least_band_factor",
                    .unit = "1",
                    .meaning = "the band becomes narrower than its parts tell by no more than this factor"},
                   sensor::least_band_factor);
  visitor.constant({.name = "most_band_factor",
                    .unit = "1",
                    .meaning = "the band becomes wider than its parts tell by no more than this factor"},
                   sensor::most_band_factor);
  visitor.constant(
      {.name = "flow_residual_factor",
       .unit = "1",
       .meaning = "half the width that the flow's own residual takes in the band, over its standard deviation"},
      sensor::flow_residual_factor);
  visitor.constant(
      {.name = "slip_smoothing_s", .unit = "s", .meaning = "pace at which the flow rate follows a slip and its swings"},
      sensor::slip_smoothing_s);
  visitor.constant({.name = "temperature_smoothing_s", .unit = "s", .meaning = "smoothing of the oil temperature"},
                   sensor::temperature_smoothing_s);
}

/// Calls visitor.constant(Constant, value) of each.
template <class Visitor>
void describe_constants(Visitor&& visitor) {
  describe_map_constants(visitor);
  describe_coil_constants(visitor);
  describe_position_constants(visitor);
  describe_friction_constants(visitor);
  describe_pressure_constants(visitor);
  describe_answer_constants(visitor);
}

}  // namespace spoolflow::model

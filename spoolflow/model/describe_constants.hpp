#pragma once
/// The sensor's constants that are the same for all valves; see parameter.hpp. Their values stand where they are used.
#include "spoolflow/model/describe_band.hpp"
#include "spoolflow/model/describe_dither_constants.hpp"
#include "spoolflow/model/describe_signal_constants.hpp"
#include "spoolflow/model/describe_whole_valve_constants.hpp"
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::model {

/// Of friction at rest.
template <class Visitor>
void describe_friction_constants(Visitor& visitor) {
  visitor.constant(
      {.name = "presliding_smoothing_s", .unit = "s", .meaning = "smoothing of the position for pre-sliding friction"},
      sensor::presliding_smoothing_s);
  visitor.constant(
      {.name = "presliding_deadband_deviations",
       .unit = "1",
       .meaning = "standard deviations of the smoothed position's noise that count as no motion in pre-sliding"},
      sensor::presliding_deadband_deviations);
  visitor.constant({.name = "doubtful_engagement_deadbands",
                    .unit = "1",
                    .meaning = "an engagement of the backlash by so many deadbands counts half"},
                   sensor::doubtful_engagement_deadbands);
  visitor.constant({.name = "engagement_certainty",
                    .unit = "1",
                    .meaning = "share of the half-width on the other side of the estimate that is excluded "
                               "where the backlash surely engages"},
                   sensor::engagement_certainty);
  visitor.constant({.name = "engagement_memory_s",
                    .unit = "s",
                    .meaning = "for so long after engagement the end of the backlash is known"},
                   sensor::engagement_memory_s);
  visitor.constant({.name = "least_stiffness_share",
                    .unit = "1",
                    .meaning = "share of the contact's stiffness at the limit of sticking"},
                   sensor::least_stiffness_share);
  visitor.constant(
      {.name = "sticking_limit_deviations",
       .unit = "1",
       .meaning =
           "standard deviations of pre-sliding friction by which friction at rest may exceed the sticking limit"},
      sensor::sticking_limit_deviations);
  visitor.constant({.name = "longest_rest_s", .unit = "s", .meaning = "longest rest that counts"},
                   sensor::longest_rest_s);
  visitor.constant({.name = "least_rest_s", .unit = "s", .meaning = "shortest time at rest, as a divisor"},
                   sensor::least_rest_s);
  visitor.constant({.name = "breakaway_delay_s", .unit = "s", .meaning = "delay of a break-away in the position"},
                   sensor::breakaway_delay_s);
  visitor.constant({.name = "unknown_rest_s",
                    .unit = "s",
                    .meaning = "for so long after the first sample no break-away counts: how long the spool had rested "
                               "is not known"},
                   sensor::unknown_rest_s);
  visitor.constant({.name = "shortest_rest_s", .unit = "s", .meaning = "a spool breaks away only after so long a rest"},
                   sensor::shortest_rest_s);
}

/// Of the estimated pressure difference before and between observations.
template <class Visitor>
void describe_pressure_constants(Visitor& visitor) {
  visitor.constant({.name = "first_pressure_share",
                    .unit = "1",
                    .meaning = "estimate before the first sample, as a share of the highest pressure difference"},
                   sensor::first_pressure_share);
  visitor.constant(
      {.name = "first_deviation_share", .unit = "1", .meaning = "its standard deviation, as a share of the same"},
      sensor::first_deviation_share);
  visitor.constant({.name = "most_deviation_share",
                    .unit = "1",
                    .meaning = "share of the same up to which the standard deviation grows, by drift or by forces "
                               "that it does not explain"},
                   sensor::most_deviation_share);
}

/// Of a current that the coil cannot have had.
template <class Visitor>
void describe_current_guard_constants(Visitor& visitor) {
  visitor.constant({.name = "questioned_change_share",
                    .unit = "1",
                    .meaning = "share of the fastest change of the current from which one is looked at"},
                   sensor::questioned_change_share);
  visitor.constant({.name = "longest_voltage_mean_s",
                    .unit = "s",
                    .meaning = "the voltage of samples further apart does not count as their mean"},
                   sensor::longest_voltage_mean_s);
}

/// Of the update by an innovation, while the spool slides or breaks away.
template <class Visitor>
void describe_innovation_constants(Visitor& visitor) {
  visitor.constant({.name = "innovation_averaging_s",
                    .unit = "s",
                    .meaning = "sliding over which normalised innovations squared are averaged"},
                   sensor::innovation_averaging_s);
  visitor.constant({.name = "usual_innovation_squared",
                    .unit = "1",
                    .meaning = "their average where the band has the width of its parts"},
                   sensor::usual_innovation_squared);
  visitor.constant({.name = "innovation_gate",
                    .unit = "1",
                    .meaning = "standard deviations beyond which an innovation raises the variance"},
                   sensor::innovation_gate);
  visitor.constant({.name = "gate_opening_s", .unit = "s", .meaning = "time constant of that"}, sensor::gate_opening_s);
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
}

/// Of how the supply has been seen to move.
template <class Visitor>
void describe_process_noise_constants(Visitor& visitor) {
  visitor.constant({.name = "observed_deviation_share",
                    .unit = "1",
                    .meaning = "the pressure difference counts as observed where it is known to this share of what the "
                               "forces' noise makes of it"},
                   sensor::observed_deviation_share);
  visitor.constant({.name = "process_noise_rise",
                    .unit = "1",
                    .meaning = "share by which the process noise follows a larger observed change"},
                   sensor::process_noise_rise);
  visitor.constant({.name = "process_noise_fall", .unit = "1", .meaning = "the same for a smaller one"},
                   sensor::process_noise_fall);
  visitor.constant({.name = "first_observed_process_noise",
                    .unit = "1",
                    .meaning = "least process noise when the pressure difference is first observed"},
                   sensor::first_observed_process_noise);
  visitor.constant(
      {.name = "informative_drift_share",
       .unit = "1",
       .meaning = "a change counts half where its drift variance is so many times that of the forces' noise"},
      sensor::informative_drift_share);
  visitor.constant({.name = "measurement_delay_s",
                    .unit = "s",
                    .meaning = "measurement delay of the pressure difference by the forces"},
                   sensor::measurement_delay_s);
  visitor.constant({.name = "least_covariance_Pa",
                    .unit = "Pa",
                    .meaning = "a smaller covariance of pressure difference and friction ratio is none"},
                   sensor::least_covariance_Pa);
  visitor.constant({.name = "vanishing_breakaway_Pa",
                    .unit = "Pa",
                    .meaning = "a smaller pressure difference by a break-away error is none"},
                   sensor::vanishing_breakaway_Pa);
  visitor.constant({.name = "most_variance_Pa2",
                    .unit = "Pa2",
                    .meaning = "a variance of the pressure difference that reaches this resets the estimate"},
                   sensor::most_variance_Pa2);
}

/// Of the band while the spool moves.
template <class Visitor>
void describe_band_constants(Visitor& visitor) {
  visitor.constant(
      {.name = "least_band_factor", .unit = "1", .meaning = "least factor on the width of the band's parts"},
      sensor::least_band_factor);
  visitor.constant(
      {.name = "most_band_factor", .unit = "1", .meaning = "largest factor on the width of the band's parts"},
      sensor::most_band_factor);
  visitor.constant(
      {.name = "flow_residual_factor",
       .unit = "1",
       .meaning = "half the width that the flow's own residual takes in the band, over its standard deviation"},
      sensor::flow_residual_factor);
  visitor.constant({.name = "friction_share_per_speed_s_per_m",
                    .unit = "s/m",
                    .meaning = "half the width that friction's dependence on the spool's speed takes in the band, as a "
                               "share of friction over the speed"},
                   sensor::friction_share_per_speed_s_per_m);
  visitor.constant(
      {.name = "most_friction_share_of_speed", .unit = "1", .meaning = "the same at most, as a share of friction"},
      sensor::most_friction_share_of_speed);
  visitor.constant(
      {.name = "unshown_drop_share",
       .unit = "1",
       .meaning = "while the spool slides, friction that falls within milliseconds by more than this share "
                  "of it counts as uncertainty of the forces: the position shows late that the spool "
                  "stops or turns"},
      sensor::unshown_drop_share);
  visitor.constant({.name = "displaced_friction_factor",
                    .unit = "1",
                    .meaning = "half the width that friction takes in the band, over the share of it by which its "
                               "ratio in operation differs from the calibrated one"},
                   sensor::displaced_friction_factor);
  visitor.constant({.name = "innovation_factor",
                    .unit = "1",
                    .meaning = "half the width that an innovation takes in the band while the spool slides, over it"},
                   sensor::innovation_factor);
  visitor.constant({.name = "constrained_correction_factor",
                    .unit = "1",
                    .meaning = "half-width of the band from the constrained correction at rest, over that correction"},
                   sensor::constrained_correction_factor);
}

/// Of answers that are late or held.
template <class Visitor>
void describe_held_constants(Visitor& visitor) {
  visitor.constant({.name = "longest_regular_step_s",
                    .unit = "s",
                    .meaning = "a time step of this length or more is estimated with time_fault"},
                   sensor::longest_regular_step_s);
  visitor.constant({.name = "unobserved_stroke_s",
                    .unit = "s",
                    .meaning = "time in which an unobserved spool is assumed to cross its stroke: the band "
                               "of the held answer opens"},
                   sensor::unobserved_stroke_s);
}

/// Of the band at rest, while the spool slips, and at the highest pressure difference.
template <class Visitor>
void describe_rest_band_constants(Visitor& visitor) {
  visitor.constant({.name = "asymmetry_share",
                    .unit = "1",
                    .meaning = "share of the difference between what is left open to either side at rest, by which "
                               "the pressure difference is expected beyond the estimate"},
                   sensor::asymmetry_share);
  visitor.constant({.name = "ripple_share",
                    .unit = "1",
                    .meaning = "how far the band reaches beyond the highest calibrated pressure difference, as a share "
                               "of it"},
                   sensor::ripple_share);
  visitor.constant({.name = "capped_pressure_reach",
                    .unit = "1",
                    .meaning = "multiple of the highest pressure difference that no valve bears: there the band ends "
                               "where the answer is capped"},
                   sensor::capped_pressure_reach);
  visitor.constant({.name = "slip_widening", .unit = "1", .meaning = "factor on the band while the spool slips"},
                   sensor::slip_widening);
  visitor.constant(
      {.name = "interval_share",
       .unit = "1",
       .meaning = "half the width to one side that friction's interval at rest leaves, over what it leaves "
                  "to that side times its share of the interval"},
      sensor::interval_share);
  visitor.constant(
      {.name = "least_interval_N", .unit = "N", .meaning = "no interval of friction at rest counts as shorter"},
      sensor::least_interval_N);
  visitor.constant(
      {.name = "unobserved_room_share",
       .unit = "1",
       .meaning =
           "share of what friction leaves by which a supply that moved at rest is taken to have gone on unobserved"},
      sensor::unobserved_room_share);
}

/// Of the oil temperature's signal.
template <class Visitor>
void describe_oil_constants(Visitor& visitor) {
  visitor.constant({.name = "temperature_smoothing_s", .unit = "s", .meaning = "smoothing of the oil temperature"},
                   sensor::temperature_smoothing_s);
  visitor.constant(
      {.name = "coldest_oil_K", .unit = "K", .meaning = "a lower oil temperature is a fault of its sensor"},
      sensor::coldest_oil_K);
  visitor.constant({.name = "warmest_oil_K", .unit = "K", .meaning = "and a higher one"}, sensor::warmest_oil_K);
  visitor.constant({.name = "oil_leap_K",
                    .unit = "K",
                    .meaning = "a reading further from those before is a fault of the oil temperature's sensor"},
                   sensor::oil_leap_K);
  visitor.constant({.name = "longest_oil_fault_s", .unit = "s", .meaning = "until it has lasted so long"},
                   sensor::longest_oil_fault_s);
  visitor.constant({.name = "first_oil_fault_s",
                    .unit = "s",
                    .meaning = "that fault has lasted so long where it is there before a plausible reading"},
                   sensor::first_oil_fault_s);
}

/// Calls visitor.constant(Constant, value) of each.
template <class Visitor>
void describe_constants(Visitor&& visitor) {
  describe_map_constants(visitor);
  describe_coil_constants(visitor);
  describe_position_constants(visitor);
  describe_slip_constants(visitor);
  describe_position_fault_constants(visitor);
  describe_closed_constants(visitor);
  describe_friction_constants(visitor);
  describe_pressure_constants(visitor);
  describe_innovation_constants(visitor);
  describe_current_guard_constants(visitor);
  describe_process_noise_constants(visitor);
  describe_band_constants(visitor);
  describe_held_constants(visitor);
  describe_rest_band_constants(visitor);
  describe_oil_constants(visitor);
  describe_dither_constants(visitor);
  describe_dither_request_constants(visitor);
  describe_whole_valve_constants(visitor);
  describe_machine_constants(visitor);
}

}  // namespace spoolflow::model

#pragma once
/// The sensor's constants of its signals, from maps and coil to position, each described once; see parameter.hpp.
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
                    .meaning = "lower limit of the slope of the flow force over the pressure difference"},
                   sensor::least_force_per_pressure_N_Pa);
  visitor.constant({.name = "viscosity_origin_K",
                    .unit = "K",
                    .meaning = "the logarithm of viscosity is linear in one over the distance to this temperature"},
                   sensor::viscosity_origin_K);
  visitor.constant({.name = "lowest_oil_K", .unit = "K", .meaning = "no oil counts as colder"}, sensor::lowest_oil_K);
}

template <class Visitor>
void describe_coil_constants(Visitor& visitor) {
  visitor.constant({.name = "shortest_step_s", .unit = "s", .meaning = "lower limit of the coil's time step"},
                   sensor::shortest_step_s);
  visitor.constant(
      {.name = "flux_rate_error_share",
       .unit = "1",
       .meaning = "error of the flux rate's model as a share of it, where the coil's resistance is followed"},
      sensor::flux_rate_error_share);
  visitor.constant({.name = "coil_averaging_s",
                    .unit = "s",
                    .meaning = "averaging of voltage, current and flux rate for the resistance"},
                   sensor::coil_averaging_s);
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
  visitor.constant({.name = "resistance_current_share",
                    .unit = "1",
                    .meaning = "least mean current that says something of the resistance, as a share of the largest"},
                   sensor::resistance_current_share);
  visitor.constant(
      {.name = "known_resistance_share",
       .unit = "1",
       .meaning = "how well the resistance must be known, as a share of it, before it is called implausible"},
      sensor::known_resistance_share);
  visitor.constant(
      {.name = "unanswered_voltage_share",
       .unit = "1",
       .meaning = "voltage that no current answers before the current counts as not measured, as a share of what "
                  "holds the largest current"},
      sensor::unanswered_voltage_share);
}

/// Of blocks and windows of positions.
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
  visitor.constant(
      {.name = "slowing_travel_ratio",
       .unit = "1",
       .meaning = "a spool whose newest window travels less than one over this of the others is about to stop"},
      sensor::slowing_travel_ratio);
  visitor.constant({.name = "longest_dither_block_s",
                    .unit = "s",
                    .meaning = "a block of positions under dither ends after so long at the latest"},
                   sensor::longest_dither_block_s);
  visitor.constant(
      {.name = "shortest_block_s", .unit = "s", .meaning = "lower limit of a block's length: velocities divide by it"},
      sensor::shortest_block_s);
  visitor.constant({.name = "fastest_m_per_s", .unit = "m/s", .meaning = "no spool moves faster"},
                   sensor::fastest_m_per_s);
  visitor.constant({.name = "velocity_smoothing_s", .unit = "s", .meaning = "smoothing of the velocity"},
                   sensor::velocity_smoothing_s);
}

/// Of a spool that slips.
template <class Visitor>
void describe_slip_constants(Visitor& visitor) {
  visitor.constant({.name = "slip_speed_m_per_s", .unit = "m/s", .meaning = "speed above which motion is a slip"},
                   sensor::slip_speed_m_per_s);
  visitor.constant(
      {.name = "slip_deviations", .unit = "1", .meaning = "standard deviations of the noise that a slip exceeds"},
      sensor::slip_deviations);
  visitor.constant(
      {.name = "slip_settling_s", .unit = "s", .meaning = "how long friction and inertia are in motion after a slip"},
      sensor::slip_settling_s);
}

/// Of what the position signal may credibly do.
template <class Visitor>
void describe_position_fault_constants(Visitor& visitor) {
  visitor.constant(
      {.name = "credible_jump_deviations",
       .unit = "1",
       .meaning = "standard deviations of the noise up to which a change of the position signal is credible"},
      sensor::credible_jump_deviations);
  visitor.constant({.name = "credible_jump_m", .unit = "m", .meaning = "and so much more"}, sensor::credible_jump_m);
  visitor.constant({.name = "position_noise_excess",
                    .unit = "1",
                    .meaning = "factor of the calibrated noise beyond which the position's second differences count"},
                   sensor::position_noise_excess);
  visitor.constant(
      {.name = "position_noise_follow_share",
       .unit = "1",
       .meaning = "share of the calibrated noise by which the median of these differences moves with each block"},
      sensor::position_noise_follow_share);
  visitor.constant({.name = "quiet_current_share",
                    .unit = "1",
                    .meaning = "share of the largest current: a smaller change from sample to sample is no motion"},
                   sensor::quiet_current_share);
  visitor.constant({.name = "quiet_voltage_share",
                    .unit = "1",
                    .meaning = "the same for the voltage, as a share of what holds the largest current"},
                   sensor::quiet_voltage_share);
  visitor.constant({.name = "quiet_jump_m",
                    .unit = "m",
                    .meaning = "no acceleration is credible for more than this where neither changed"},
                   sensor::quiet_jump_m);
  visitor.constant(
      {.name = "calm_current_rate_per_s",
       .unit = "1/s",
       .meaning = "a current that changes by a larger share of the largest current a second moves the spool harder"},
      sensor::calm_current_rate_per_s);
  visitor.constant({.name = "hard_current_rate_per_s",
                    .unit = "1/s",
                    .meaning = "once more the largest acceleration is credible for each so much beyond"},
                   sensor::hard_current_rate_per_s);
  visitor.constant({.name = "current_change_forgotten_per_s",
                    .unit = "1/s",
                    .meaning = "share of the largest current by which such a change is forgotten a second"},
                   sensor::current_change_forgotten_per_s);
  visitor.constant({.name = "longest_position_fault_s",
                    .unit = "s",
                    .meaning = "a jump of the position signal that lasts longer is accepted"},
                   sensor::longest_position_fault_s);
  visitor.constant({.name = "longest_position_doubt_s",
                    .unit = "s",
                    .meaning = "and marked until so long after it, within which the way back is accepted at once"},
                   sensor::longest_position_doubt_s);
  visitor.constant(
      {.name = "direction_only_m", .unit = "m", .meaning = "size of a travel that shows the direction only"},
      sensor::direction_only_m);
}

/// Of a position that stays closed against the forces.
template <class Visitor>
void describe_closed_constants(Visitor& visitor) {
  visitor.constant(
      {.name = "unmoved_factor",
       .unit = "1",
       .meaning = "no spool rests closed against a magnetic force that exceeds the spring by so many times "
                  "what friction and the forces' uncertainty hold"},
      sensor::unmoved_factor);
  visitor.constant(
      {.name = "longest_unmoved_s", .unit = "s", .meaning = "a position that says so for longer is in doubt"},
      sensor::longest_unmoved_s);
  visitor.constant({.name = "no_open_stop_m",
                    .unit = "m",
                    .meaning = "no spool gets there: the open stop of a valve of which none is known"},
                   sensor::no_open_stop_m);
}

}  // namespace spoolflow::model

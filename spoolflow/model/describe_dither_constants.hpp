#pragma once
/// The sensor's constants of dither and of asking for it, each described once; see parameter.hpp.
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/dither_request.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::model {

/// Of dither and of the friction that swings with it.
template <class Visitor>
void describe_dither_constants(Visitor& visitor) {
  visitor.constant(
      {.name = "least_dither_swing_share",
       .unit = "1",
       .meaning = "least swing of the current that counts as dither, peak to peak over the largest current"},
      sensor::least_dither_swing_share);
  visitor.constant({.name = "turning_share",
                    .unit = "1",
                    .meaning = "the current has turned where it went back by this share of its last swing"},
                   sensor::turning_share);
  visitor.constant({.name = "longest_dither_period_s", .unit = "s", .meaning = "no dither has a longer period"},
                   sensor::longest_dither_period_s);
  visitor.constant({.name = "shortest_dither_period_s", .unit = "s", .meaning = "no coil follows a shorter one"},
                   sensor::shortest_dither_period_s);
  visitor.constant({.name = "alike_ratio",
                    .unit = "1",
                    .meaning = "periods of dither are alike where neither is more than so many times the other"},
                   sensor::alike_ratio);
  visitor.constant({.name = "periods_of_dither", .unit = "1", .meaning = "periods alike that count as dither"},
                   sensor::periods_of_dither);
  visitor.constant({.name = "unlike_weight", .unit = "1", .meaning = "weight of a half period that is not alike"},
                   sensor::unlike_weight);
  visitor.constant({.name = "swing_following",
                    .unit = "1",
                    .meaning = "share of itself by which half the swing follows that of a period at most"},
                   sensor::swing_following);
  visitor.constant({.name = "missed_swing",
                    .unit = "1",
                    .meaning = "of a swing, samples miss this over the square of those in a period"},
                   sensor::missed_swing);
  visitor.constant({.name = "missed_middle",
                    .unit = "1",
                    .meaning = "one standard deviation of its middle, over half the swing and the same"},
                   sensor::missed_middle);
  visitor.constant({.name = "slip_excess_factor",
                    .unit = "1",
                    .meaning = "2 pi over the root of 4.5: the excess of force in a slip that dither makes"},
                   sensor::slip_excess_factor);
  visitor.constant({.name = "swing_deviation_share",
                    .unit = "1",
                    .meaning = "half the width that peaks no sample met take in the band, over half the swing"},
                   sensor::swing_deviation_share);
  visitor.constant({.name = "loosened_ageing_share",
                    .unit = "1",
                    .meaning = "one standard deviation of what ageing adds to a break-away under dither, over itself"},
                   sensor::loosened_ageing_share);
}

/// Of asking for dither.
template <class Visitor>
void describe_dither_request_constants(Visitor& visitor) {
  visitor.constant(
      {.name = "amplitude_raise_per_s",
       .unit = "1/s",
       .meaning = "pace at which the amplitude is raised where dither does not free the spool, as a share of it"},
      sensor::amplitude_raise_per_s);
  visitor.constant(
      {.name = "dither_settling_s", .unit = "s", .meaning = "settling time before the amplitude is raised"},
      sensor::dither_settling_s);
  visitor.constant({.name = "amplitude_lowering",
                    .unit = "1",
                    .meaning = "by so much it is lowered after a request that brought the wanted band, as a ratio: too "
                               "little shows soon, too "
                               "much does not show at all"},
                   sensor::amplitude_lowering);
  visitor.constant({.name = "dither_rise_s",
                    .unit = "s",
                    .meaning = "in which dither rises from nothing to its amplitude, and falls to nothing again"},
                   sensor::dither_rise_s);
  visitor.constant(
      {.name = "dither_fall_s", .unit = "s", .meaning = "in which dither falls to nothing after a request"},
      sensor::dither_fall_s);
}

}  // namespace spoolflow::model

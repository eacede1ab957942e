#pragma once
/// The sensor's constants of the centre between two directions of flow, each described once; see parameter.hpp.
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/observer.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"

namespace spoolflow::model {

template <class Visitor>
void describe_port_pressure_constants(Visitor& visitor) {
  visitor.constant({.name = "port_pressure_deviation_Pa",
                    .unit = "Pa",
                    .meaning = "one standard deviation of a measured port pressure"},
                   sensor::port_pressure_deviation_Pa);
  visitor.constant({.name = "sure_drop_Pa", .unit = "Pa", .meaning = "a pressure drop of this size has a sure sign"},
                   sensor::sure_drop_Pa);
  visitor.constant({.name = "share_following_s",
                    .unit = "s",
                    .meaning = "time constant of the inlet edge's share of the path's drop by measured pressures"},
                   sensor::share_following_s);
  visitor.constant({.name = "inlet_share_deviation", .unit = "1", .meaning = "one standard deviation of it then"},
                   sensor::inlet_share_deviation);
}

template <class Visitor>
void describe_whole_valve_constants(Visitor& visitor) {
  visitor.constant(
      {.name = "other_direction_m",
       .unit = "m",
       .meaning = "a spool that reads so far beyond half the overlap on the closed side opens the other direction"},
      sensor::other_direction_m);
  visitor.constant({.name = "centre_hysteresis_m",
                    .unit = "m",
                    .meaning = "how far beyond the centre the spool stands on the other side"},
                   sensor::centre_hysteresis_m);
  visitor.constant({.name = "centring_m",
                    .unit = "m",
                    .meaning = "a reading nearer to the centre may be of a spool that the springs centre"},
                   sensor::centring_m);
  visitor.constant({.name = "centring_rest_s",
                    .unit = "s",
                    .meaning = "for how long both coils are silent there before the position's zero is accepted"},
                   sensor::centring_rest_s);
  visitor.constant({.name = "zero_following_s", .unit = "s", .meaning = "pace at which the zero follows the reading"},
                   sensor::zero_following_s);
  visitor.constant({.name = "sign_margin_m",
                    .unit = "m",
                    .meaning = "nearer to the centre the sign of the flow is not sure, where no overlap covers it"},
                   sensor::sign_margin_m);
  visitor.constant({.name = "sign_deviations",
                    .unit = "1",
                    .meaning = "and so many standard deviations of the position's noise more"},
                   sensor::sign_deviations);
  visitor.constant({.name = "load_settling_s", .unit = "s", .meaning = "pace at which a load settles to another flow"},
                   sensor::load_settling_s);
  visitor.constant({.name = "idle_settling_s",
                    .unit = "s",
                    .meaning = "the iron of a coil has come to rest where its current has been silent for so long"},
                   sensor::idle_settling_s);
  visitor.constant({.name = "idle_patience_s",
                    .unit = "s",
                    .meaning = "that long an idle solenoid's flux waits for a sample with less else to do"},
                   sensor::idle_patience_s);
  describe_port_pressure_constants(visitor);
}

}  // namespace spoolflow::model

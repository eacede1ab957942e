#pragma once
/// The sensor's constants of what machines do to a valve, each described once; see parameter.hpp.
#include "spoolflow/model/parameter.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::model {

template <class Visitor>
void describe_machine_constants(Visitor& visitor) {
  visitor.constant({.name = "most_held_currents",
                    .unit = "1",
                    .meaning = "so many currents in a row that leapt as no coil lets them are replaced"},
                   sensor::most_held_currents);
  visitor.constant({.name = "stalled_friction_share",
                    .unit = "1",
                    .meaning = "a stalled actuator is as likely as not where the flow force is this share of sliding "
                               "friction"},
                   sensor::stalled_friction_share);
  visitor.constant({.name = "stalled_pressure_share",
                    .unit = "1",
                    .meaning = "and the pressure difference this share of the highest that is answered"},
                   sensor::stalled_pressure_share);
  visitor.constant({.name = "stalled_pressure_reach",
                    .unit = "1",
                    .meaning = "beyond so many times that share no actuator is thought to have stalled"},
                   sensor::stalled_pressure_reach);
  visitor.constant({.name = "least_likelihood", .unit = "1", .meaning = "the band holds a stall that is more likely"},
                   sensor::least_likelihood);
  visitor.constant({.name = "least_conductance_share",
                    .unit = "1",
                    .meaning = "changes of the conductance are taken of no less than this share of the widest opening's"},
                   sensor::least_conductance_share);
  visitor.constant({.name = "saturation_share",
                    .unit = "1",
                    .meaning = "one standard deviation of the force's rise above the largest current of its map, as a "
                               "share of it"},
                   sensor::saturation_share);
  visitor.constant({.name = "freeing_share",
                    .unit = "1",
                    .meaning = "dither frees the spool where half the swing of friction is so many times sliding "
                               "friction"},
                   sensor::freeing_share);
}

}  // namespace spoolflow::model

#include "spoolflow/rig/bench/wear.hpp"

namespace spoolflow::rig {

PlantParameters worn(PlantParameters plant, const Wear& wear) {
  for (MeteringEdge* edge : {&plant.edge_PA, &plant.edge_PB, &plant.edge_AT, &plant.edge_BT}) {
    edge->edge_radius_m += wear.edge_rounding_m;
  }
  for (Friction* friction : {&plant.spool_friction, &plant.solenoid_a.friction, &plant.solenoid_b.friction}) {
    friction->wear_factor *= wear.friction_factor;
  }
  for (Spring* spring : {&plant.spring_a, &plant.spring_b}) {
    spring->relaxation += wear.spring_relaxation;
  }
  plant.solenoid_b.coil.shorted_turns_fraction += wear.shorted_turns_fraction;
  plant.solenoid_b.coil.added_resistance_ohm += wear.added_resistance_ohm;
  return plant;
}

}  // namespace spoolflow::rig

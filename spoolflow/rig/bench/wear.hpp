#pragma once
/// What years do to a valve, on top of its plant parameters.
#include "spoolflow/rig/plant/plant_parameters.hpp"

namespace spoolflow::rig {

struct Wear {
  double edge_rounding_m = 0.0;
  double friction_factor = 1.0;
  double spring_relaxation = 0.0;
  double shorted_turns_fraction = 0.0;
  double added_resistance_ohm = 0.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"edge_rounding_m", "m", 0, 8e-5,
                    "added to the radius of every metering edge; erosion reaches tens of micrometres"},
          self.edge_rounding_m);
    visit(Parameter{"friction_factor", "1", 0.2, 5, "on spool and armature friction; 1 is new, 2 is varnished"},
          self.friction_factor);
    visit(Parameter{"spring_relaxation", "1", 0, 0.4, "share of the springs' force lost"}, self.spring_relaxation);
    visit(Parameter{"shorted_turns_fraction", "1", 0, 0.4, "of solenoid b's winding"}, self.shorted_turns_fraction);
    visit(Parameter{"added_resistance_ohm", "ohm", 0, 10, "plug or broken strand of solenoid b"},
          self.added_resistance_ohm);
  }
};

/// The plant after that wear.
[[nodiscard]] PlantParameters worn(PlantParameters plant, const Wear& wear);

}  // namespace spoolflow::rig

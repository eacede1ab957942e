#pragma once
/// How one valve of a series differs from the next: a seeded draw on the figures that manufacturing holds least well.
#include <cstdint>
#include <string>

#include "spoolflow/rig/instruments/lvdt.hpp"
#include "spoolflow/rig/plant/plant_parameters.hpp"

namespace spoolflow::rig {

/// Relative standard deviations unless the unit says otherwise; draws are cut off at 2.5 of them. The ageing time of
/// the contacts is drawn evenly over its logarithm.
struct ManufacturingSpread {
  double amount = 0.0;
  double spring_rate = 0.02;
  double spring_preload = 0.06;
  double friction = 0.20;
  double notch_width = 0.02;
  double overlap_m = 8.0e-6;
  double discharge = 0.01;
  double clearance = 0.10;
  double coil_resistance = 0.02;
  double radial_gap = 0.06;
  double coercive_field = 0.15;
  double reversible_share = 0.15;
  double saturation = 0.01;
  double sensor_gain = 0.002;
  double sensor_zero_m = 5.0e-6;
  double sensor_drift = 0.15;
  double ageing_time = 4.0;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"amount", "1", 0, 2, "factor on all figures below; 0 is the nominal valve, 1 a usual series"},
          self.amount);
    visit(Parameter{"spring_rate", "1", 0, 0.1, "wire diameter to the fourth power; EN 15800 grade 1 about 5 %"},
          self.spring_rate);
    visit(Parameter{"spring_preload", "1", 0, 0.3, "lengths of spring and housing add up"}, self.spring_preload);
    visit(Parameter{"friction", "1", 0, 0.5, "fit, straightness and surface of spool and armature"}, self.friction);
    visit(Parameter{"notch_width", "1", 0, 0.1, "milled notches: 20 to 30 micrometres of a millimetre"},
          self.notch_width);
    visit(Parameter{"overlap_m", "m", 0, 3e-5, "edge positions of spool and body"}, self.overlap_m);
    visit(Parameter{"discharge", "1", 0, 0.05, "sharpness of the edges"}, self.discharge);
    visit(Parameter{"clearance", "1", 0, 0.3, "half a micrometre of five"}, self.clearance);
    visit(Parameter{"coil_resistance", "1", 0, 0.1, "data sheets allow 5 to 7 %"}, self.coil_resistance);
    visit(Parameter{"radial_gap", "1", 0, 0.2, "film or tube wall between armature and tube"}, self.radial_gap);
    visit(Parameter{"coercive_field", "1", 0, 0.4, "annealing of the iron"}, self.coercive_field);
    visit(Parameter{"reversible_share", "1", 0, 0.4, "of its magnetisation; grain and stress"}, self.reversible_share);
    visit(Parameter{"saturation", "1", 0, 0.04, "melt and annealing"}, self.saturation);
    visit(Parameter{"sensor_gain", "1", 0, 0.02, "after setting"}, self.sensor_gain);
    visit(Parameter{"sensor_zero_m", "m", 0, 3e-5, "after setting"}, self.sensor_zero_m);
    visit(Parameter{"sensor_drift", "1", 0, 0.5, "of the zero's drift"}, self.sensor_drift);
    visit(Parameter{"ageing_time", "1", 1, 10,
                    "how many times faster or slower stiction grows at rest, at most: no data sheet states it"},
          self.ageing_time);
  }
};

/// Draws valve number `seed` of the series; the result is inside every described range.
void draw(const ManufacturingSpread& spread, std::uint64_t seed, PlantParameters& plant, Lvdt& lvdt);

/// The table [tolerances] of campaign.toml: one standard deviation between the units of that series, of a usual one
/// where the amount is 0. What the spread leaves alone has no key. `nominal`: of one direction, P to B.
[[nodiscard]] std::string tolerances_text(const ManufacturingSpread& spread, const PlantParameters& nominal);

}  // namespace spoolflow::rig

#include "spoolflow/calibration/type/variation.hpp"

#include <fmt/format.h>

namespace spoolflow::calibration {

const std::array<VariationAbout, variations>& all_variations() {
  static constexpr std::array<VariationAbout, variations> about{{
      {"turns", "1", 0.003, "turns of the coil", "winding machines count to a turn in some 300"},
      {"permeance", "1", 0.015, "permeance of the air gap", "film or tube wall between armature and tube, +-3 %"},
      {"coercivity", "1", 0.08, "width of the magnetic hysteresis", "annealing of the iron"},
      {"resistance", "1", 0.02, "coil resistance", "data sheets: +-5 % of the wire"},
      {"spring_preload", "1", 0.03, "spring force, as a share of its mean", "lengths of spring and housing add up"},
      {"spring_rate", "1", 0.02, "rise of the spring force", "EN 15800 grade 1: +-5 %"},
      {"edge_position", "m", 8e-6, "position at which the edge opens", "ground edges of spool and body: +-16 um"},
      {"edge_width", "1", 0.01, "conductance of the edge", "milled notches: 20 um of 2 mm"},
      {"flow_force", "1", 0.02, "flow force at a given flow", "jet angle +-1 degree about 69 degrees"},
      {"flow_force_tilt", "1", 0.01, "rise of that along the stroke", "the jet angle's slope over the opening"},
      {"spool_friction", "1", 0.2, "spool friction without pressure", "fit, straightness and surface"},
      {"pressure_friction", "1", 0.2, "spool friction that pressure adds", "fit, straightness and surface"},
      {"armature_friction", "1", 0.2, "armature friction", "fit, straightness and surface"},
      {"ageing_time", "ln", 0.8, "time in which friction grows at rest", "no data sheet: to four times either way"},
      {"position_zero", "m", 5e-6, "position reading at the closed end", "after setting"},
      {"position_gain", "1", 0.003, "gain of the position sensor", "after setting"},
  }};
  return about;
}

std::string written_deviation(std::string_view unit, double value) {
  const auto [scale, name] = written_unit(unit);
  return fmt::format("{:+.3g} {}", scale * value, name);
}

}  // namespace spoolflow::calibration

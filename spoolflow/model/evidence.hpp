#pragma once
/// What was measured on the bench, kept beside the maps made from it, so that a report can show both.
#include <vector>

namespace spoolflow::model {

/// Magnetic force over position at one held current, both directions of motion (paper Fig 8).
struct MagneticForceLoop {
  double current_A;
  std::vector<double> position_m;
  std::vector<double> opening_N;
  std::vector<double> closing_N;
};

/// Axial force without solenoid, flow and pressure difference over position at one held pressure difference (paper Fig
/// 5).
struct AxialForceLoop {
  double pressure_difference_set_Pa;
  std::vector<double> position_m;
  std::vector<double> opening_N;
  std::vector<double> closing_N;
  std::vector<double> flow_m3_per_s;           ///< both directions averaged
  std::vector<double> pressure_difference_Pa;  ///< measured, both directions averaged
};

/// The largest slope of flow over flow force that the map has at each point: how much a newton costs there.
struct SensitivityMap {
  std::vector<double> position_m;                 ///< rows
  std::vector<double> pressure_difference_Pa;     ///< columns
  std::vector<double> flow_per_force_m3_per_s_N;  ///< row after row, dQ/dF >= 0; NaN-free, blind points at the cap
};

/// Whether one flow force means one flow rate.
struct Uniqueness {
  double unique_from_m;                ///< above this opening the force rises with every level
  double blind_below_m;                ///< below it the levels' forces do not differ by more than their noise
  std::vector<double> ambiguous_at_m;  ///< positions at which a higher level has the lower force
};

struct Evidence {
  std::vector<MagneticForceLoop> magnetic_force;
  std::vector<AxialForceLoop> axial_force;
  SensitivityMap sensitivity;
  Uniqueness uniqueness;
};

}  // namespace spoolflow::model

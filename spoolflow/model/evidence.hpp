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
/// 5). Of a path whose edges were measured one at a time, or whose load passes unequal flows, as the edges make it.
struct AxialForceLoop {
  double pressure_difference_set_Pa;
  std::vector<double> position_m;
  std::vector<double> opening_N;
  std::vector<double> closing_N;
  std::vector<double> flow_m3_per_s;           ///< both directions averaged
  std::vector<double> pressure_difference_Pa;  ///< measured, both directions averaged
};

/// One part of `solenoid_dynamic`, of its held positions the middle one, thinned for drawing: what the load cell showed
/// and what the calibrated actuator makes of the same current.
struct SolenoidTrace {
  int test;  ///< the protocol's number of the part; 0 where the recording does not state it
  double position_m;
  std::vector<double> current_A;
  std::vector<double> measured_N;  ///< magnetic force
  std::vector<double> model_N;     ///< with hysteresis and eddy currents
  std::vector<double> map_N;       ///< of the averaged map over the coil current alone
};

/// What the full sensor's maps leave of the bench strokes at one held value, over position: mean and RMS of the
/// samples' deviations from map and friction.
struct MapResidual {
  double held;               ///< coil current [A] or pressure difference [Pa]
  double oil_temperature_K;  ///< 0 where it was not recorded
  std::vector<double> position_m;
  std::vector<double> mean_N;
  std::vector<double> rms_N;
};

/// What the full sensor leaves of the bench recordings; empty without an observer.
struct BenchResiduals {
  std::vector<SolenoidTrace> solenoid;      ///< empty without `solenoid_dynamic`
  std::vector<MapResidual> magnetic_force;  ///< rising current
  std::vector<MapResidual> axial_force;     ///< of each recording, rising pressure difference
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
  BenchResiduals bench;
  SensitivityMap sensitivity;
  Uniqueness uniqueness;
};

}  // namespace spoolflow::model

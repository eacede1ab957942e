#pragma once
/// What a campaign's bench recordings must satisfy among themselves.
#include <vector>

#include "spoolflow/plausibility/relation.hpp"
#include "spoolflow/plausibility/valve_curves.hpp"

namespace spoolflow::plausibility {

/// Of spring and axial-force recordings: stiffness, one spring in all, one flow curve, jet momentum, set pressure,
/// travel.
void add_hydraulic_deviations(std::vector<Deviation>& to, const HydraulicCurves& curves,
                              const recording::Recording* spring, const std::vector<const recording::Recording*>& maps);

/// Of two axial-force maps and more at oil temperatures of their own: flow and flow force change with the temperature
/// along one line, little, and no map stands apart.
void add_map_deviations(std::vector<Deviation>& to, const HydraulicCurves& curves,
                        const std::vector<const recording::Recording*>& maps);

/// Of the solenoid's force map: it pulls, more with more current, over the stroke.
void add_magnetic_deviations(std::vector<Deviation>& to, const MagneticCurves& curves, const recording::Recording& map);

/// Largest recorded flow against the rated one.
void add_rated_flow_deviation(std::vector<Deviation>& to, const HydraulicCurves& curves, double rated_flow_m3_per_s);

/// Voltage over current while the current holds [Ohm]; NaN where the recording does not determine it.
[[nodiscard]] double coil_resistance(const recording::Recording& means);

/// Of the coil's resistance in all recordings that determine it, and beside `known_Ohm` where that is > 0.
void add_resistance_deviation(std::vector<Deviation>& to, const std::vector<const recording::Recording*>& recordings,
                              double known_Ohm = 0);

}  // namespace spoolflow::plausibility

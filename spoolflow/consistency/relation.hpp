#pragma once
/// What forces, flow and coil must satisfy, whatever the valve: each as a deviation beside what sound recordings reach.
#include <string>
#include <vector>

#include "spoolflow/consistency/valve_curves.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::consistency {

struct Deviation {
  std::string of;      ///< "balance of forces in operation"
  std::string shown;   ///< its value with unit, as a message tells it
  double over_limit;   ///< 0: none; above 1: beyond what any sound recording here has, with a margin
  std::string file{};  ///< that it is of, where it is of one alone
  double ratio = 1;    ///< of a reference to what it should be
  double blocks = 0;   ///< how many it was judged on, where a slip may change that
};
/// Names of relations that are asked for.
inline constexpr const char* largest_opening = "largest opening";
inline constexpr const char* reference_ratio = "reference flow over that of edge and pressure difference";

/// Of spring and axial-force recordings: stiffness, one spring in all, one flow curve, jet momentum, set pressure,
/// travel.
void add_hydraulic_deviations(std::vector<Deviation>& to, const HydraulicCurves& curves,
                              const recording::Recording* spring, const std::vector<const recording::Recording*>& maps);

/// Of the solenoid's force map: it pulls, more with more current, over the stroke.
void add_magnetic_deviations(std::vector<Deviation>& to, const MagneticCurves& curves, const recording::Recording& map);

/// Of an operating run against both: balance of forces, flow against what edge and pressure difference make, positions.
/// Reads current, position, and of flow and pressure difference what is there.
void add_run_deviations(std::vector<Deviation>& to, const HydraulicCurves& hydraulics, const MagneticCurves& magnetics,
                        const recording::Recording& run);

/// Largest recorded flow against the rated one.
void add_rated_flow_deviation(std::vector<Deviation>& to, const HydraulicCurves& curves, double rated_flow_m3_per_s);

/// Voltage over current while the current holds [Ohm]; NaN where the recording does not tell.
[[nodiscard]] double coil_resistance(const recording::Recording& means);

/// Of the coil's resistance in all recordings that tell it, and beside `known_Ohm` where that is > 0.
void add_resistance_deviation(std::vector<Deviation>& to, const std::vector<const recording::Recording*>& recordings,
                              double known_Ohm = 0);

/// One relation as it stands, and with a slip undone.
struct Change {
  const Deviation* before;
  const Deviation* after;
};

/// What is worst as it stands and no longer with the slip undone; neither may be empty.
[[nodiscard]] Change telling_change(const std::vector<Deviation>& before, const std::vector<Deviation>& after);
/// "balance of forces in operation goes from 41 N RMS to 0.3 N RMS"
[[nodiscard]] std::string told(const Change& change);

/// Whether as much is judged as before, and on no less than half of the blocks: a slip must not hide what it is to
/// explain.
[[nodiscard]] bool judges_as_much(const std::vector<Deviation>& after, const std::vector<Deviation>& before);

/// Of all together, 0: nothing.
[[nodiscard]] double badness(const std::vector<Deviation>& deviations);

}  // namespace spoolflow::consistency

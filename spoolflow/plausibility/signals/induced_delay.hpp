#pragma once
/// Position and current whose times are some milliseconds apart: a spool that moves induces a voltage in its coil at
/// that instant, whatever friction and current do.
#include <optional>

#include "spoolflow/plausibility/signals/known_coil.hpp"
#include "spoolflow/plausibility/signals/motion_trace.hpp"

namespace spoolflow::plausibility {

/// By how much the position comes late [s], within 0.15 s either way; < 0: early. The voltage beside the resistance is
/// that of a changing flux linkage, v - R i = dL/di i' + dL/dx x' (Faraday's law), about those moments at which the
/// spool moves faster than half of `stroke_m` a second; the shift of x' that leaves least. Omits hysteresis and eddy
/// currents, so that the run is without dither; sound runs have -8 to 6 ms. Nothing from -15 to 9 ms, or where one of
/// those leaves hardly more.
[[nodiscard]] std::optional<double> induced_delay_s(const MotionTrace& run, const KnownCoil& coil, double stroke_m);

}  // namespace spoolflow::plausibility

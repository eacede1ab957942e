#pragma once
/// Events of one cycle of the spool, gathered until they can be evaluated together: the pressure difference, which
/// nobody measures, is one for all of them but for a slow walk and a load behind the valve, so that the shape over
/// position is left to distinguish the faults.
#include <array>
#include <optional>

#include "spoolflow/monitor/contact_reading.hpp"

namespace spoolflow::monitor {

inline constexpr std::size_t least_window_events = 8;
inline constexpr double longest_window_s = 60;
inline constexpr double longest_event_gap_s = 20;  ///< a longer pause ends the window
/// Events in one direction within this share of the stroke and this time [s] count as one.
inline constexpr double alike_position_share = 0.025;
inline constexpr double alike_time_s = 1.0;
/// A window whose events go one way but for this share identifies nothing: friction and pressure difference are one
/// there.
inline constexpr double least_return_share = 0.1;
/// A valve that stays closed so long [s] ends the window: behind it the pressure may do as it likes.
inline constexpr double closing_pause_s = 0.3;

/// Result of a window.
struct WindowResult {
  Evidence evidence;
  double pressure_difference_Pa;
  double misfit;     ///< mean squared residual over what is expected: 1 where the model holds
  bool shape_shows;  ///< the pressure difference was steady enough for all magnitudes, else for friction alone
  std::size_t events;
  double friction_unknown = 0;  ///< by what the strokes' speed makes of it, one standard deviation [usual_fault]
  ContactReading contact{};     ///< where the pressure difference was steady
};

/// Fits a window. None where it has too few events or nothing explains them.
[[nodiscard]] std::optional<WindowResult> fit_window(const sensor::ObserverParameters<double>& valve, double stroke_m,
                                                     const WindowState& window);

/// Adds an event. Returns the result of the window that it ended, if any.
[[nodiscard]] std::optional<WindowResult> add_event(const sensor::ObserverParameters<double>& valve, double stroke_m,
                                                    WindowState& window, const ForceEvent& event);
/// Ends the window now.
[[nodiscard]] std::optional<WindowResult> end_window(const sensor::ObserverParameters<double>& valve, double stroke_m,
                                                     WindowState& window);

}  // namespace spoolflow::monitor

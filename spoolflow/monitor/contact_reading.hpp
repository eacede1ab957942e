#pragma once
/// What one window identifies of the contacts beside the magnitudes: friction in each region of the stroke, the force
/// at which the spool breaks away, how often it sticks, and the width of its loop over the current. Both directions
/// together: what flow force and pressure difference are wrong by cancels in their difference.
#include <array>
#include <cmath>
#include <type_traits>

#include "spoolflow/monitor/signatures.hpp"

namespace spoolflow::monitor {

inline constexpr std::size_t window_events = 72;

/// The events of the window that is being gathered.
struct WindowState {
  std::array<ForceEvent, window_events> events{};
  std::size_t count = 0;
  double closed_s = 0;
};
static_assert(std::is_trivially_copyable_v<WindowState>);

/// Thirds of the part of the stroke in which events are used.
inline constexpr std::size_t friction_regions = 3;
/// A region is identified from so many events each way on.
inline constexpr double least_region_events = 2;

/// A mean with its weight, 1/variance; weight 0: nothing identified.
struct Weighted {
  double value = 0;
  double weight = 0;
};

struct ContactReading {
  std::array<Weighted, friction_regions> friction_ratio{};  ///< over the model's in operation
  Weighted breakaway_N;                                     ///< size of friction where the spool breaks away
  double breakaway_expected_N = 0;                          ///< of the model, after the same rests
  Weighted stick_share;                                     ///< break-aways among all events
  Weighted width_A;             ///< coil current opening less closing at one position and pressure difference
  double width_expected_A = 0;  ///< of the model
};

[[nodiscard]] ContactReading read_contacts(const sensor::ObserverParameters<double>& valve, double stroke_m,
                                           const WindowState& window, double pressure_difference_Pa);

/// What faster strokes than those of calibration do to friction [usual_fault], as contacts age while they slide.
struct SpeedEffect {
  double less;     ///< friction than the calibrated, >= 0
  double unknown;  ///< one standard deviation about it
};
[[nodiscard]] SpeedEffect friction_by_speed(const WindowState& window, double stroke_m);

/// All windows so far, the newest counting most.
struct Contacts {
  ContactReading mean;
};
static_assert(std::is_trivially_copyable_v<Contacts>);

/// Windows are forgotten by and by: this many count.
inline constexpr double contact_memory_windows = 20;

void learn(Contacts& contacts, const ContactReading& reading);

/// One standard deviation of the mean; the errors of the map that windows share are not in it.
[[nodiscard]] inline double deviation(const Weighted& mean) {
  return mean.weight > 0 ? 1 / std::sqrt(mean.weight) : 0.0;
}

}  // namespace spoolflow::monitor

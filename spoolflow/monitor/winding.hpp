#pragma once
/// The winding's resistance, from windows of voltage and current: u = R i + d flux/dt, integrated over a window in
/// which the coil carries current, with the change of flux linkage from the model's static map.
#include <cmath>
#include <type_traits>

#include "spoolflow/sensor/actuator.hpp"

namespace spoolflow::monitor {

/// Length of a window [s].
inline constexpr double winding_window_s = 1.0;
/// A window counts where the current is nowhere below this share of the largest.
inline constexpr double winding_current_share = 0.08;
/// The static map's flux linkage is taken to be wrong by this share of its change, one standard deviation, and by ...
inline constexpr double flux_change_error_share = 0.1;
/// ... so much at any time [Wb], for hysteresis.
inline constexpr double flux_error_Wb = 1e-3;
/// Voltage and current channels are wrong by this share of each other, one standard deviation.
inline constexpr double resistance_channel_error = 0.002;
/// The winding warms and cools: what was learnt counts for about so many windows.
inline constexpr double winding_memory_windows = 60;

/// A copper winding's resistance per kelvin, as a share of that at 20 degC (IEC 60028).
inline constexpr double copper_per_K = 3.93e-3;

struct WindingState {
  double window_s = 0;
  double voltage_Vs = 0;  ///< integral of the voltage over the window
  double charge_As = 0;
  double flux_begin_Wb = 0;
  double temperature_Ks = 0;
  double resistance_Ohm = 0;  ///< weighted mean of the last windows
  double weight_1_Ohm2 = 0;   ///< sum of their weights, forgotten by and by
  double scatter = 0;         ///< mean squared deviation in units of a window's weight
  double oil_temperature_K = 0;
  double windows = 0;  ///< that identified something
};
static_assert(std::is_trivially_copyable_v<WindingState>);

struct WindingSample {
  double time_step_s;
  double current_A;
  double voltage_V;
  double position_m;
  double oil_temperature_K;
};

/// One standard deviation of the mean resistance [Ohm].
inline double resistance_deviation_Ohm(const WindingState& state) {
  const double common = resistance_channel_error * state.resistance_Ohm;
  return std::sqrt(std::fmax(state.scatter, 1.0) / state.weight_1_Ohm2 + common * common);
}

/// The window that ends now, as a resistance [Ohm]; keeps the weighted mean.
inline void close_winding_window(WindingState& state, double flux_change_Wb) {
  const double resistance = (state.voltage_Vs - flux_change_Wb) / state.charge_As;
  const double share = flux_change_error_share * flux_change_Wb;
  const double error_Ohm = std::sqrt(share * share + flux_error_Wb * flux_error_Wb) / state.charge_As;
  const double weight = 1 / (error_Ohm * error_Ohm);
  const double left = 1 - 1 / winding_memory_windows;
  state.weight_1_Ohm2 = state.weight_1_Ohm2 * left + weight;
  const double deviation = resistance - state.resistance_Ohm;
  const double gain = weight / state.weight_1_Ohm2;
  if (state.windows > 0) state.scatter += gain * (deviation * deviation * weight - state.scatter);
  state.resistance_Ohm += gain * deviation;
  state.oil_temperature_K += gain * (state.temperature_Ks / state.window_s - state.oil_temperature_K);
  ++state.windows;
}

inline void begin_winding_window(WindingState& state) {
  state.window_s = state.voltage_Vs = state.charge_As = state.temperature_Ks = 0;
}

/// One sample; all numbers finite. `largest_current_A` as calibrated. Returns whether a window ended with it.
inline bool follow_winding(const sensor::ActuatorParameters<double>& actuator, double largest_current_A,
                           WindingState& state, const WindingSample& sample) {
  if (sample.current_A < winding_current_share * largest_current_A) {
    begin_winding_window(state);
    return false;
  }
  const double flux_Wb = actuator.coil.flux_linkage.map.at(sample.current_A, sample.position_m).value;
  if (state.window_s == 0) {
    state.flux_begin_Wb = flux_Wb;
    state.window_s = 1e-12;  // the window begins after this sample
    return false;
  }
  state.window_s += sample.time_step_s;
  state.voltage_Vs += sample.voltage_V * sample.time_step_s;
  state.charge_As += sample.current_A * sample.time_step_s;
  state.temperature_Ks += sample.oil_temperature_K * sample.time_step_s;
  if (state.window_s < winding_window_s) return false;
  close_winding_window(state, flux_Wb - state.flux_begin_Wb);
  begin_winding_window(state);
  return true;
}

}  // namespace spoolflow::monitor

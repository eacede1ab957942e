#pragma once
/// The valve's on-board electronics: position control, dither, and a current-controlled output stage for each of the
/// two solenoids, all at one period. Where `sign_chooses`, the sign of the position controller's output chooses the
/// solenoid, with the dither on it alone, and the other stage lets its current go and switches off.
#include <cmath>

#include "spoolflow/rig/electronics/current_control.hpp"
#include "spoolflow/rig/electronics/position_control.hpp"
#include "spoolflow/rig/numerics/elementary_functions.hpp"
#include "spoolflow/rig/numerics/noise.hpp"
#include "spoolflow/rig/numerics/parameter.hpp"

namespace spoolflow::rig {

inline constexpr double electronics_period_s = 1e-4;  ///< 10 kHz

/// Course of one period, all with the same amplitude and phase.
enum class DitherShape { sine, square, triangle };

/// Tremble of the set current that keeps spool and armature from sticking.
struct Dither {
  double amplitude_A = 0.0;
  double frequency_Hz = 160.0;
  DitherShape shape = DitherShape::sine;  ///< key `shape`: "sine", "square" or "triangle"

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Parameter{"amplitude_A", "A", 0, 1, "0: none; 5 to 15 % of the rated current"}, self.amplitude_A);
    visit(Parameter{"frequency_Hz", "Hz", 20, 500, "amplifiers offer 60 to 200 Hz"}, self.frequency_Hz);
  }
};

/// Course of a period over its turns: -1 to 1, rising through 0 at whole turns. A square is 1 in the first half.
inline double dither_wave(DitherShape shape, double turns) {
  if (shape == DitherShape::sine) return sine_of_turns(turns);
  const double phase = turns - std::floor(turns);
  if (shape == DitherShape::square) return phase < 0.5 ? 1.0 : -1.0;
  return phase < 0.25 ? 4.0 * phase : phase < 0.75 ? 2.0 - 4.0 * phase : 4.0 * phase - 4.0;
}

/// The dither's share of the set current [A].
inline double dither_A(const Dither& dither, double time_s) {
  return dither.amplitude_A * dither_wave(dither.shape, dither.frequency_Hz * time_s);
}

struct Electronics {
  PositionControl position;
  CurrentControl current;
  Dither dither;
  double current_noise_A = 2.0e-3;
  bool sign_chooses = false;  ///< of the whole valve, both directions; else the side of the set position chooses

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit("position", self.position);
    visit("current", self.current);
    visit("dither", self.dither);
    visit(Parameter{"current_noise_A", "A", 0, 0.1, "of the stage's own current sensing, one conversion"},
          self.current_noise_A);
  }
};

struct ElectronicsState {
  PositionControlState position;
  CurrentControlState current_a;
  CurrentControlState current_b;
  double time_s = 0;
};

struct ElectronicsInput {
  double position_set_m = 0;
  double position_signal_m = 0;
  double current_a_A = 0;
  double current_b_A = 0;
};

struct SolenoidVoltages {
  double a_V = 0;
  double b_V = 0;
};

/// A stage without a set current: pulls what is left of the current down, then is off, so that noise does not drive it.
inline double release(const CurrentControl& control, CurrentControlState& state, double signal_A) {
  constexpr double off_below_A = 0.02;
  state = {};
  if (signal_A < off_below_A) return 0.0;
  return quantised(std::max(-control.proportional_V_per_A * signal_A, -control.supply_V),
                   control.supply_V / control.duty_steps);
}

/// One period of electronics where the sign of the controller's output chooses.
inline SolenoidVoltages step_of_both(const Electronics& electronics, ElectronicsState& state,
                                     const ElectronicsInput& input, Noise& noise) {
  const double set_A = step_of_both(electronics.position, state.position, input.position_set_m, input.position_signal_m,
                                    electronics_period_s);
  state.time_s += electronics_period_s;
  const double tremble_A = dither_A(electronics.dither, state.time_s);
  const auto drive = [&](CurrentControlState& stage, double stage_set_A, double current_A) {
    const double signal_A = current_A + electronics.current_noise_A * noise.normal();
    return state.position.on && stage_set_A > 0
               ? step(electronics.current, stage, stage_set_A + tremble_A, signal_A, electronics_period_s)
               : release(electronics.current, stage, signal_A);
  };
  return {.a_V = drive(state.current_a, -set_A, input.current_a_A),
          .b_V = drive(state.current_b, set_A, input.current_b_A)};
}

/// One period. Each solenoid's current signal carries the stage's own noise.
inline SolenoidVoltages step(const Electronics& electronics, ElectronicsState& state, const ElectronicsInput& input,
                             Noise& noise) {
  if (electronics.sign_chooses) return step_of_both(electronics, state, input, noise);
  double set_A =
      step(electronics.position, state.position, input.position_set_m, input.position_signal_m, electronics_period_s);
  state.time_s += electronics_period_s;
  if (state.position.on) {
    const double direction = input.position_set_m > 0 ? 1 : -1;
    set_A += direction * dither_A(electronics.dither, state.time_s);
  }
  const auto drive = [&](CurrentControlState& stage, double stage_set_A, double current_A) {
    const double signal_A = current_A + electronics.current_noise_A * noise.normal();
    return step(electronics.current, stage, stage_set_A, signal_A, electronics_period_s);
  };
  return {.a_V = drive(state.current_a, -set_A, input.current_a_A),
          .b_V = drive(state.current_b, set_A, input.current_b_A)};
}

}  // namespace spoolflow::rig

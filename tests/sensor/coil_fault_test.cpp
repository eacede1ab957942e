/// A coil's faults in everything that a spool does, each with each: what the voltage says of the coil does not depend
/// on what the forces are asked for.
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "spoolflow/sensor/whole_valve/whole_valve.hpp"
#include "tests/sensor/valve_course.hpp"

namespace spoolflow::sensor {
namespace {

constexpr double run_s = 5;
/// A sound coil breaks when the spool has long been at what it does.
constexpr double breaks_s = 0.5;
/// The fault is named from here on: the resistance is followed within seconds.
constexpr double named_from_s = 3.5;

/// What the spool and the coil do.
struct Mode {
  const char* name;
  Course course;
  double dither_A = 0;  ///< half of peak to peak, 100 Hz
};

Course begun(double position_m) {
  return Course({.position_m = position_m});
}

std::vector<Mode> modes() {
  Course strokes = begun(0.5e-3), stick_slip = begun(0.5e-3);
  while (strokes.end_s() < run_s) strokes.slide(2.2e-3, 0.4).slide(0.5e-3, 0.4);
  while (stick_slip.end_s() < run_s) stick_slip.rest(0.1, 1.1).slip(stick_slip.last().position_m + 0.06e-3, 6e-3);
  const Course rest = begun(1e-3).rest(run_s, 0.2);
  const Course slide = begun(0.4e-3).rest(0.1, 1).slide(2.3e-3, run_s);
  return {{"rest", rest},
          {"closed", begun(0.1e-3).rest(run_s, 0.2)},
          {"slide", slide},
          {"strokes", strokes},
          {"stick-slip", stick_slip},
          {"dithered at rest", rest, 0.05},
          {"half freed by dither", rest, 0.15},
          {"freed by dither", rest, 0.3},
          {"freed by strong dither", rest, 0.5},
          {"freed by dither as it slides", slide, 0.3}};
}

/// Nearly a square, as a driver makes of it. Friction carries the current: 32 N/A.
std::vector<ValveSample> sampled(const Mode& mode, double step_s) {
  const auto dithered = [&mode](double time_s) {
    ValveInstant now = mode.course(time_s);
    const double square = std::clamp(4 * std::sin(2 * std::numbers::pi * 100 * time_s), -1.0, 1.0);
    const double friction_N = ClosedFormValve::spool_friction_N(now.pressure_difference_Pa, now.oil_temperature_K);
    now.friction_share += mode.dither_A * 32 / friction_N * square;
    return now;
  };
  return ClosedFormRun(closed_form, dithered).sampled(run_s, step_s);
}

/// What is wrong with the coil, or with what is measured of it.
struct Fault {
  const char* name;
  double voltage;  ///< over the sound coil's
  double current;
  bool is_one;
};
constexpr std::array faults{Fault{"none", 1, 1, false}, Fault{"bad contact", 3, 1, true},
                            Fault{"shorted turns", 0.4, 1, true}, Fault{"current not measured", 1, 0, true},
                            Fault{"voltage not measured", NAN, 1, false}};

class CoilFault : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(SampledEvery, CoilFault, testing::Values(200e-6, 1e-3, 2e-3),
                         [](const auto& rate) { return std::to_string(static_cast<int>(1e6 * rate.param)) + "us"; });

TEST_P(CoilFault, IsNamedWhateverTheSpoolDoesAndASoundCoilNever) {
  const ObserverParameters<double> valve = closed_form_observer<double>(closed_form);
  for (const Mode& mode : modes()) {
    const std::vector<ValveSample> run = sampled(mode, GetParam());
    for (const Fault& fault : faults) {
      ObserverState<double> state{};
      double time_s = 0;
      int samples = 0, named = 0, named_sound = 0;
      for (const ValveSample& sample : run) {
        Sample<double> measured = sample.measured;
        time_s += measured.time_step_s;
        if (time_s > breaks_s) {
          measured.voltage_V *= fault.voltage;
          measured.current_A *= fault.current;
        }
        const bool names = has(step(valve, state, measured).status, Status::coil_fault);
        const bool is_sound = !fault.is_one || time_s < breaks_s;
        named_sound += names && is_sound ? 1 : 0;
        named += names && !is_sound && time_s > named_from_s ? 1 : 0;
        samples += time_s > named_from_s ? 1 : 0;
      }
      EXPECT_EQ(named, fault.is_one ? samples : 0) << mode.name << ", " << fault.name;
      EXPECT_EQ(named_sound, 0) << mode.name << ", " << fault.name;
    }
  }
}

TEST(CoilFault, OfAWholeValveIsNamedWhileTheOtherSolenoidIsAtWork) {
  const ObserverParameters<double> direction = closed_form_observer<double>(closed_form);
  const WholeValveParameters<double> valve{&direction, &direction};
  for (const Mode& mode : modes()) {
    for (const bool side_a : {false, true}) {
      WholeValveState<double> state{};
      double time_s = 0;
      for (const ValveSample& sample : sampled(mode, 1e-3)) {
        const Sample<double>& own = sample.measured;
        constexpr double bias_A = 0.3;
        time_s += own.time_step_s;
        const double fault = time_s > breaks_s ? 3 : 1;
        WholeValveSample<double> measured{
            own.time_step_s,       bias_A,         own.current_A,        bias_A * ClosedFormValve::resistance_Ohm,
            fault * own.voltage_V, own.position_m, own.oil_temperature_K};
        if (side_a) {
          std::swap(measured.current_a_A, measured.current_b_A);
          std::swap(measured.voltage_a_V, measured.voltage_b_V);
          measured.position_m = -measured.position_m;
        }
        step(valve, state, measured);
      }
      EXPECT_TRUE(has(state.open.last.status, Status::coil_fault)) << mode.name << (side_a ? ", a" : ", b");
    }
  }
}

}  // namespace
}  // namespace spoolflow::sensor

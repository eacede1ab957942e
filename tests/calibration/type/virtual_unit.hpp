#pragma once
/// Recordings of a unit as the sensor's own functions have it, in closed form: for how a fit behaves, not for how well
/// it does on a valve.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "spoolflow/calibration/type/unit_parameters.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {

inline constexpr double virtual_step_s = 2e-3;

/// The coil current at which all forces of a sliding spool balance, found from the memory before the sample.
inline double balancing_current_A(const sensor::ObserverParameters<double>& unit,
                                  const sensor::ActuatorState<double>& before, double position_m, double wanted_N,
                                  double direction) {
  double low_A = 0, high_A = unit.largest_current_A;
  for (int k = 0; k < 22; ++k) {
    const double middle_A = 0.5 * (low_A + high_A);
    sensor::ActuatorState<double> tried = before;
    const auto answer =
        sensor::step(unit.actuator, tried, sensor::Sample<double>{virtual_step_s, middle_A, {}, position_m, {}}, false);
    (answer.magnetic_force_N - direction * answer.friction_half_width_N < wanted_N ? low_A : high_A) = middle_A;
  }
  return low_A;
}

/// Where a spool is that sticks and slips on its way, and how its friction stands beside that of sliding: it grows
/// while the spool sticks and falls while it slips.
struct StickSlip {
  double travel_m, friction_share;
};
inline StickSlip stick_slip(double even_travel_m, double slip_m) {
  constexpr double sticks = 0.9, beyond = 0.2;  // of the time; of friction
  if (!(slip_m > 0)) return {even_travel_m, 1};
  const double slips = std::floor(even_travel_m / slip_m), phase = even_travel_m / slip_m - slips;
  if (phase < sticks) return {slips * slip_m, 1 + beyond * (2 * phase / sticks - 1)};
  const double slipped = (phase - sticks) / (1 - sticks);
  return {(slips + slipped) * slip_m, 1 + beyond * (1 - 2 * slipped)};
}

/// A slow stroke at each pressure difference, from rest at the closed end, as CSV. `stalls_after_s` after its begin the
/// piston stands at its end, and 0.1 bar are left. With `slip_m` the spool sticks and slips so far each time.
inline void write_strokes(const std::filesystem::path& file, const sensor::ObserverParameters<double>& unit,
                          const std::vector<double>& pressures_bar, double full_stroke_m, double way_s = 6,
                          double stalls_after_s = 1e9, double slip_m = 0) {
  std::ofstream out(file);
  out.precision(9);
  out << "time_s,position_mm,current_A,oil_temperature_C,pressure_difference_bar,flow_reference_L_min\n";
  sensor::ActuatorState<double> actuator{};
  constexpr double rest_s = 0.5, turn_s = 0.2;
  const double stroke_s = 2 * (way_s + turn_s), end_s = rest_s + stroke_s * static_cast<double>(pressures_bar.size());
  const double read_zero_m = unit.spring.curve.axis.first;  // where the closed end reads
  double time_s = 0;
  for (bool first = true; time_s < end_s; time_s += virtual_step_s) {
    const double moving_s = std::max(0.0, time_s - rest_s);
    const double phase = std::fmod(moving_s, stroke_s);
    const auto stroke = static_cast<std::size_t>(moving_s / stroke_s);
    const double pressure_bar =
        phase < stalls_after_s ? pressures_bar[std::min(stroke, pressures_bar.size() - 1)] : 0.1;
    const double share = phase < way_s            ? phase / way_s
                         : phase < way_s + turn_s ? 1
                                                  : std::max(0.0, 1 - (phase - way_s - turn_s) / way_s);
    const bool opens = phase < way_s;
    const double way_m = 0.99 * full_stroke_m;
    const StickSlip moved = stick_slip(way_m * (opens ? share : 1 - share), slip_m);
    const double position_m = read_zero_m + (opens ? moved.travel_m : way_m - moved.travel_m);
    const double direction = opens ? 1 : share > 0 && share < 1 ? -1 : 0;
    const sensor::EdgePoint<double> edge = unit.edge.at(323.15, pressure_bar * 1e5, position_m);
    const double ratio = unit.friction.operation_ratio;
    const double wanted_N = unit.spring.at(position_m).value + (pressure_bar > 0 ? edge.flow_force_N : 0) +
                            direction * ratio * moved.friction_share * edge.friction_N;
    const double current_A =
        time_s < rest_s ? 0 : balancing_current_A(unit, actuator, position_m, wanted_N, ratio * direction);
    sensor::step(unit.actuator, actuator, sensor::Sample<double>{virtual_step_s, current_A, {}, position_m, {}}, first);
    first = false;
    const double last_m = unit.edge.position_m.at(sensor::edge_positions - 1);
    const double opens_on = std::max(1.0, position_m / last_m);  // an edge does beyond its table
    out << time_s << ',' << 1e3 * position_m << ',' << current_A << ",50," << pressure_bar << ','
        << 6e4 * opens_on * edge.conductance * std::sqrt(pressure_bar * 1e5) << '\n';
  }
}

/// A spool that hangs without pressure from one place to the next, 0.1 mm on, opening: it rests `rest_s` until the coil
/// breaks it away. CSV.
inline void write_stick_slip(const std::filesystem::path& file, const sensor::ObserverParameters<double>& unit,
                             double rest_s, double full_stroke_m) {
  std::ofstream out(file);
  out.precision(9);
  out << "time_s,position_mm,current_A,oil_temperature_C,pressure_difference_bar\n";
  sensor::ActuatorState<double> actuator{};
  constexpr double step_m = 1e-4, slip_s = 0.04, begin_s = 0.5;
  const double zero_m = unit.spring.curve.axis.first, ratio = unit.friction.operation_ratio;
  for (double time_s = 0, share = 0; share < 0.95; time_s += virtual_step_s) {
    const double moving_s = std::max(0.0, time_s - begin_s), places = std::floor(moving_s / (rest_s + slip_s));
    const double phase_s = moving_s - places * (rest_s + slip_s), held = std::min(1.0, phase_s / rest_s);
    const double position_m = zero_m + (places + std::max(0.0, (phase_s - rest_s) / slip_s)) * step_m;
    share = position_m / full_stroke_m;
    const double bare_N = unit.edge.at(323.15, 0, position_m).friction_N;
    const double spool_N = phase_s < rest_s ? held * sensor::ageing(unit.friction, rest_s) * bare_N : bare_N;
    const double wanted_N = unit.spring.at(position_m).value + ratio * spool_N;
    const double current_A =
        time_s < begin_s ? 0 : balancing_current_A(unit, actuator, position_m, wanted_N, ratio * held);
    sensor::step(unit.actuator, actuator, sensor::Sample<double>{virtual_step_s, current_A, {}, position_m, {}},
                 time_s == 0);
    out << time_s << ',' << 1e3 * position_m << ',' << current_A << ",50,0\n";
  }
}

/// A slow stroke of a whole valve P to B, as `p_to_b` has it, and one P to A, as `p_to_a` has it in its own signs. CSV.
inline void write_whole_strokes(const std::filesystem::path& file, const sensor::ObserverParameters<double>& p_to_b,
                                const sensor::ObserverParameters<double>& p_to_a, double pressure_bar,
                                double full_stroke_m) {
  std::ofstream out(file);
  out.precision(9);
  out << "time_s,position_mm,current_a_A,current_b_A,oil_temperature_C,pressure_difference_bar,flow_reference_L_min\n";
  double from_s = 0;
  for (const double way : {1.0, -1.0}) {
    const std::filesystem::path one = file.parent_path() / "one_way.csv";
    write_strokes(one, way > 0 ? p_to_b : p_to_a, {pressure_bar}, full_stroke_m);
    std::ifstream in(one);
    std::string line;
    std::getline(in, line);  // the header
    double last_s = 0;
    while (std::getline(in, line)) {
      std::istringstream cells(line);
      double time_s = 0, position_mm = 0, current_A = 0, oil_C = 0, bar = 0, L_min = 0;
      char comma = 0;
      cells >> time_s >> comma >> position_mm >> comma >> current_A >> comma >> oil_C >> comma >> bar >> comma >> L_min;
      out << from_s + time_s << ',' << way * position_mm << ',' << (way > 0 ? 0 : current_A) << ','
          << (way > 0 ? current_A : 0) << ',' << oil_C << ',' << bar << ',' << way * L_min << '\n';
      last_s = time_s + virtual_step_s;
    }
    from_s += last_s;
  }
}

/// A valve whose directions are alike.
inline model::Model whole_of(model::Model one) {
  one.valve.direction = "both";
  one.p_to_a = model::Direction{one.condensed, one.observer, one.evidence};
  return one;
}

}  // namespace spoolflow::calibration

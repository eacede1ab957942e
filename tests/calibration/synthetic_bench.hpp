#pragma once
/// Bench recordings made from closed formulas, so that tests know what calibration must find.
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "spoolflow/recording/recording.hpp"

namespace spoolflow::calibration {

inline constexpr double bench_stroke_m = 2.4e-3;

/// One to-and-fro at a held level. Speeds in m/s, holds in samples at either end.
struct Stroke {
  double level = 0;
  double opening_speed = 120e-6;
  double closing_speed = 120e-6;
  double from_m = 0;
  double to_m = bench_stroke_m;
  int hold_samples = 50;
  bool with_closing = true;
};

/// Position over time of all strokes, with `noise_m` on the position signal.
struct Drive {
  std::vector<double> time_s, true_position_m, position_m, level, direction;
};

inline Drive drive(const std::vector<Stroke>& strokes, double noise_m, double time_step_s = 0.01) {
  Drive out;
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0, noise_m > 0 ? noise_m : 1);
  const auto push = [&](double x, double level, double direction) {
    out.time_s.push_back(static_cast<double>(out.time_s.size()) * time_step_s);
    out.true_position_m.push_back(x);
    out.position_m.push_back(noise_m > 0 ? x + noise(generator) : x);
    out.level.push_back(level);
    out.direction.push_back(direction);
  };
  for (const Stroke& stroke : strokes) {
    for (int k = 0; k < stroke.hold_samples; ++k) push(stroke.from_m, stroke.level, -1);
    for (double x = stroke.from_m; x < stroke.to_m; x += stroke.opening_speed * time_step_s) push(x, stroke.level, 1);
    for (int k = 0; k < stroke.hold_samples; ++k) push(stroke.to_m, stroke.level, 1);
    if (!stroke.with_closing) continue;
    for (double x = stroke.to_m; x > stroke.from_m; x -= stroke.closing_speed * time_step_s) push(x, stroke.level, -1);
  }
  return out;
}

inline double spring_N(double x_m) {
  return 9.0 + 12e3 * x_m + 2e5 * x_m * x_m;
}
inline double friction_N(double level) {
  return 2.0 + 0.5e-6 * level;
}
/// Flow force of an edge that opens at 0.2 mm, and its flow.
inline double opening_m(double x_m) {
  return std::fmax(0.0, x_m - 0.2e-3);
}
inline double flow_force_N(double x_m, double pressure_Pa) {
  return 3.4e-3 * opening_m(x_m) * pressure_Pa;
}
inline double flow_m3_per_s(double x_m, double pressure_Pa) {
  return 2.5e-4 * opening_m(x_m) * std::sqrt(pressure_Pa);
}
inline double magnetic_N(double current_A, double x_m) {
  return 20 * current_A * current_A * (1 + 40 * x_m);
}

/// Channels of an axial-force recording (also without pressure: level 0) of the strokes.
inline recording::Recording axial_force_recording(const std::vector<Stroke>& strokes, double position_noise_m) {
  using recording::Channel;
  const Drive motion = drive(strokes, position_noise_m);
  recording::Recording out;
  out.file = "axial.csv";
  out.column(Channel::time) = motion.time_s;
  out.column(Channel::position) = motion.position_m;
  out.column(Channel::pressure_difference_set) = motion.level;
  for (std::size_t k = 0; k < motion.time_s.size(); ++k) {
    const double x = motion.true_position_m[k];
    const double p = motion.level[k];
    out.column(Channel::axial_force).push_back(spring_N(x) + flow_force_N(x, p) + motion.direction[k] * friction_N(p));
    out.column(Channel::flow).push_back(flow_m3_per_s(x, p));
    out.column(Channel::pressure_upstream).push_back(p + 4e5);
    out.column(Channel::pressure_downstream).push_back(4e5);
    out.column(Channel::oil_temperature).push_back(323.15);
  }
  return out;
}

inline recording::Recording solenoid_recording(const std::vector<Stroke>& strokes, double position_noise_m) {
  using recording::Channel;
  const Drive motion = drive(strokes, position_noise_m);
  recording::Recording out;
  out.file = "solenoid.csv";
  out.column(Channel::time) = motion.time_s;
  out.column(Channel::position) = motion.position_m;
  out.column(Channel::current) = motion.level;
  for (std::size_t k = 0; k < motion.time_s.size(); ++k) {
    const double i = motion.level[k];
    out.column(Channel::force)
        .push_back(magnetic_N(i, motion.true_position_m[k]) - motion.direction[k] * (0.3 + 0.5 * i));
  }
  return out;
}

}  // namespace spoolflow::calibration

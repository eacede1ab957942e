#pragma once
/// What one side of a valve has shown so far: evidence of its windows, where it rests closed; and of a whole valve
/// where it rests in its centre.
#include <array>
#include <cmath>
#include <type_traits>

#include "spoolflow/monitor/condition.hpp"
#include "spoolflow/monitor/fault_parameters.hpp"

namespace spoolflow::monitor {

/// Windows are forgotten by and by: this many count.
inline constexpr double memory_windows = 20;
/// What windows share (errors of maps and signatures) does not average out: together they count as no more than so
/// many.
inline constexpr double independent_windows = 2;

/// A mean that forgets, with how much it rests on.
struct MeanEvidence {
  Evidence sum{};
  double weight = 0;
};

/// Readings of the closed stop: the coil is silent, springs centre the spool.
struct RestReading {
  double mean_m = 0;
  double lowest_m = 0;     ///< of the last readings: friction holds the spool open, never beyond the stop
  double deviation_m = 0;  ///< of one reading, one standard deviation; 0: rest_deviation_m
  double weight = 0;
  double silent_s = 0;  ///< for how long it is so now
  double sum_m = 0;
  double sum_s = 0;
};
/// Of one reading, one standard deviation: where friction leaves the spool. A spool further off was held by friction.
inline constexpr double rest_deviation_m = 6e-6;
/// The lowest reading is forgotten by this share of the distance with each that is higher.
inline constexpr double lowest_forgetting = 0.1;
inline constexpr double farthest_rest_m = 60e-6;
/// A coil is silent below this share of its largest current; a reading takes the position from the first of these times
/// [s] after it fell silent to the second.
inline constexpr double silent_current_share = 0.01;
inline constexpr double rest_begins_s = 0.1;
inline constexpr double rest_ends_s = 0.3;

/// Readings of a whole valve's centre, to which springs bring the spool from either side once both coils are silent.
/// Friction holds it short of there, as far on one side as on the other: their middle is the position sensor's zero.
struct CentreRest {
  /// Back from one side, in the valve's signs.
  struct Back {
    double mean_m = 0;
    double newest_m = 0;
    double weight = 0;
    bool paired = true;  ///< the newest has been judged together with one from the other side
  };
  std::array<Back, 2> back{};  ///< from solenoid b's side, from a's
  double pairs = 0;            ///< that were judged, forgotten by and by
  double silent_s = 0;         ///< for how long both coils are silent now
  double sum_m = 0;
  double sum_s = 0;
  int from = -1;  ///< the side on which the spool was last, index of `back`; -1: not known
};
static_assert(std::is_trivially_copyable_v<CentreRest>);
/// A spool further from the centre than this stands open: either the last side from which it comes, or held there.
inline constexpr double farthest_centre_m = 150e-6;
/// Where friction holds the spool, the middle is off by this share of how far both sides lie apart, one standard
/// deviation: the springs' ends and the contacts are not quite alike.
inline constexpr double centre_unlike_share = 0.25;

/// The position sensor's zero [m], in the valve's signs, by the readings of both sides. To be asked where both are
/// known.
[[nodiscard]] inline double centre_zero_m(const CentreRest& rest) {
  return 0.5 * (rest.back[0].mean_m + rest.back[1].mean_m);
}
/// One standard deviation of the middle of two readings [m].
[[nodiscard]] inline double centre_deviation_m(const CentreRest& rest) {
  return std::hypot(rest_deviation_m / std::sqrt(2.0),
                    centre_unlike_share * (rest.back[0].mean_m - rest.back[1].mean_m));
}

struct Learnt {
  MeanEvidence shape;     ///< of windows that identify all magnitudes
  MeanEvidence friction;  ///< of those that identify friction alone
  RestReading rest;
};
static_assert(std::is_trivially_copyable_v<Learnt>);

inline void learn(MeanEvidence& mean, const Evidence& evidence) {
  const double left = 1 - 1 / memory_windows;
  for (std::size_t k = 0; k < evidence.information.size(); ++k)
    mean.sum.information[k] = mean.sum.information[k] * left + evidence.information[k];
  for (std::size_t k = 0; k < evidence.pull.size(); ++k) mean.sum.pull[k] = mean.sum.pull[k] * left + evidence.pull[k];
  mean.weight = mean.weight * left + 1;
}

/// The same evidence where friction is off by an unknown with that standard deviation [usual_fault].
inline Evidence with_friction_unknown(const Evidence& evidence, double deviation) {
  if (!(deviation > 0)) return evidence;
  constexpr std::size_t friction = index(Magnitude::friction);
  const auto of = [&](std::size_t row) { return evidence.information[row * magnitudes + friction]; };
  const double precision = 1 / (deviation * deviation) + of(friction);
  Evidence out = evidence;
  for (std::size_t r = 0; r < magnitudes; ++r) {
    out.pull[r] -= of(r) * evidence.pull[friction] / precision;
    for (std::size_t c = 0; c < magnitudes; ++c) out.information[r * magnitudes + c] -= of(r) * of(c) / precision;
  }
  return out;
}

inline void add(Evidence& to, const MeanEvidence& mean) {
  if (mean.weight == 0) return;
  const double share = mean.weight < independent_windows ? 1.0 : independent_windows / mean.weight;
  for (std::size_t k = 0; k < to.information.size(); ++k) to.information[k] += share * mean.sum.information[k];
  for (std::size_t k = 0; k < to.pull.size(); ++k) to.pull[k] += share * mean.sum.pull[k];
}

/// One reading of one magnitude; `value` and `deviation` in usual_fault.
inline Evidence reading(Magnitude magnitude, double value, double deviation) {
  Evidence out;
  const std::size_t k = index(magnitude);
  out.information[k * magnitudes + k] = 1 / (deviation * deviation);
  out.pull[k] = value / (deviation * deviation);
  return out;
}

/// All evidence together.
inline Evidence evidence_of(const Learnt& learnt) {
  Evidence out;
  add(out, learnt.shape);
  add(out, learnt.friction);
  if (learnt.rest.weight > 0) {
    const double unit_m = usual_fault[index(Magnitude::position_zero)];
    const double readings = std::fmin(learnt.rest.weight, independent_windows);
    const double deviation_m = learnt.rest.deviation_m > 0 ? learnt.rest.deviation_m : rest_deviation_m;
    add(out,
        {reading(Magnitude::position_zero, learnt.rest.lowest_m / unit_m, deviation_m / unit_m / std::sqrt(readings)),
         1});
  }
  return out;
}

}  // namespace spoolflow::monitor

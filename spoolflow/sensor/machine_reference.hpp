#pragma once
/// What a machine knows of the oil that passed its valve, one reference at a time: how much wider the edges are than
/// the parameters say, and where the closed spool reads. Optional: the observer does not need it. On a host `spoolflow
/// recalibrate` finds friction, too.
///
///     add(passed, estimate, time_step_s);                                  // each sample of a stroke
///     update(machine, state, {2.6e-3F, 2e-6F, passed});                    // at its end
///     const MachineFinding<float> finding = finding_of(machine, state);    // what is to be done about it
///
/// Kalman filter of two states: what all volumes have in common, and what a leaking seal takes of the slow ones.
#include <type_traits>

#include "spoolflow/sensor/basis/sample.hpp"
#include "spoolflow/sensor/basis/scalar.hpp"

namespace spoolflow::sensor {

/// What is expected of wear, of a healthy model and of references before any came.
struct ReferencePriors {
  /// One standard deviation of what wear changes between two looks at a valve: width of the edges, position zero.
  static constexpr double edge_wear = 0.06, position_zero_wear_m = 15e-6;
  /// Of a healthy valve's model: what its volumes all have in common, and where its sensor reads closed.
  static constexpr double model_volume_share = 0.01, closed_uncertainty_m = 4e-6;
  /// By how much friction that strokes show differs from the model's of a healthy valve.
  static constexpr double model_friction_share = 0.07;
  /// What the sensor's volume of an interval is off by, by chance: a share of it, and a share of the rated flow.
  static constexpr double volume_chance_share = 0.015, volume_chance_flow_share = 0.005;
  /// References in which the sensor saw less than this share of the oil are of the other direction.
  static constexpr double least_seen_share = 0.3;
  /// A reference lies apart from those before beyond this share and so many standard deviations: another consumer.
  static constexpr double least_apart_share = 0.08, apart_deviations = 4;
  /// Of all references, the share that may lie apart.
  static constexpr double most_left_out = 0.4;
  /// Volumes go with the root of the width: a wider edge has more flow force, too, and the pressure difference is taken
  /// for less.
  static constexpr double volume_per_width = 0.5;
  /// Of stated areas, displacements and gains one in ten is wrong (logarithm of the odds), and then by so much, one
  /// standard deviation: another bore, a rod that counts or does not, a nominal displacement.
  static constexpr double misstated_log_odds = -2.2, misstated_share = 0.07;
  /// In natural logarithms: what is so much more likely than wear contradicts it, five times.
  static constexpr double contradiction_evidence = 1.6;
  /// One standard deviation of a seal's leakage, as a share of the rated flow.
  static constexpr double seal_wear_share = 0.0125;
  /// A finding is one beyond so many standard deviations, after so many references.
  static constexpr double finding_deviations = 2.5;
  static constexpr int least_references = 4;
  /// In which the filter forgets, in references: what wears within them is as large as usual.
  static constexpr double forgetting_references = 3600;
  /// Student's t of so many degrees of freedom: a reference that is off counts less.
  static constexpr double freedom = 4;
};

/// What holds for all references of a machine.
template <class T>
struct MachineKnowledge {
  T rated_flow_m3_per_s{};
  T share_deviation = T(0.0025);  ///< standard deviation of area or displacement, as a share
  T leakage_m3_per_s{};           ///< that the seal or pump may have, as stated
  T closed_m{};                   ///< where the parameters have the closed spool: edge.position_m.first
};

/// What the sensor saw of one interval; {} before it.
template <class T>
struct PassedVolume {
  T volume_m3{};
  T duration_s{};
};

template <class T>
struct MachineReference {
  T known_m3;      ///< that passed, by the machine: area times length, or displacement times revolutions
  T deviation_m3;  ///< of this one alone, one standard deviation: how well its ends are seen
  PassedVolume<T> seen;
};

/// Trivially copyable; {} before the first reference, and after the parameters were moved by its finding.
template <class T>
struct ReferenceState {
  T level{};           ///< logarithm of the machine's volume over the sensor's, in common
  T leak_share{};      ///< that a seal takes, of the rated flow, > 0: of the machine's volume
  T level_variance{};  ///< 0 before the first
  T covariance{};
  T leak_variance{};
  T zero_m{};  ///< mean of the closed readings, from where the parameters have them
  int taken{}, apart{}, closed{};
};
static_assert(std::is_trivially_copyable_v<ReferenceState<float>>);
static_assert(sizeof(MachineKnowledge<float>) + sizeof(ReferenceState<float>) + sizeof(PassedVolume<float>) <= 512);

enum class ReferenceVerdict : unsigned char {
  taken,
  not_seen,  ///< no numbers, or the sensor saw hardly any of the oil, or far too much: another direction, or valve
  apart      ///< from those before: likely another consumer was open, or an end was missed
};

/// Whether the parameters are to be moved, or why the references cannot be right.
enum class MachineVerdict : unsigned char {
  too_few,
  stays,     ///< no change is clear of its uncertainty
  moves,     ///< write the page (parameter_image/moved_page.hpp)
  leaks,     ///< slow strokes miss more oil than fast ones: mend the seal
  less_oil,  ///< edges would be narrower, and wear widens them: a seal, another consumer, a wrong area
  apart,     ///< two fifths of the references lie apart
  more_oil   ///< edges would be so much wider that a wrong area is far likelier than wear
};

template <class T>
struct MachineFinding {
  MachineVerdict verdict;
  T edge_width;            ///< conductance and flow force, as a share more
  T edge_width_deviation;  ///< one standard deviation
  T position_zero_m;       ///< the sensor reads so much too much; 0: as it is
  T leakage_m3_per_s;      ///< that the references miss, > 0
};

namespace detail {

/// Of a number between 0.3 and 3.4, to 2e-4; the series needs no library.
template <class T>
constexpr T logarithm(T value) {
  const T z = (value - T(1)) / (value + T(1)), z2 = z * z;
  return T(2) * z * (T(1) + z2 * (T(1) / T(3) + z2 * (T(1) / T(5) + z2 * (T(1) / T(7) + z2 * T(1) / T(9)))));
}

/// Of a small number, less 1.
template <class T>
constexpr T exponential_less_one(T value) {
  return value * (T(1) + value * (T(0.5) + value * (T(1) / T(6) + value * T(1) / T(24))));
}

/// Wear since the last reference, to no more than what is usual of a valve that nobody has looked at.
template <class T>
constexpr void forget(ReferenceState<T>& state) {
  constexpr T level2 = T(ReferencePriors::volume_per_width * ReferencePriors::edge_wear *
                         ReferencePriors::volume_per_width * ReferencePriors::edge_wear),
              leak2 = T(ReferencePriors::seal_wear_share * ReferencePriors::seal_wear_share);
  const bool first = !(state.level_variance > T(0));
  constexpr T share = T(1 / ReferencePriors::forgetting_references);
  state.level_variance = first ? level2 : smaller(state.level_variance + share * level2, level2);
  state.leak_variance = first ? leak2 : smaller(state.leak_variance + share * leak2, leak2);
}

}  // namespace detail

/// One sample of the interval that a reference is of.
template <class T>
constexpr void add(PassedVolume<T>& passed, const Estimate<T>& estimate, T time_step_s) {
  passed.volume_m3 += time_step_s * estimate.flow_m3_per_s;
  passed.duration_s += time_step_s;
}

/// One reference: two states, one measurement. Some hundred instructions, none of which depends on how many came
/// before.
template <class T>
constexpr ReferenceVerdict update(const MachineKnowledge<T>& machine, ReferenceState<T>& state,
                                  const MachineReference<T>& reference) {
  const T known_m3 = reference.known_m3, seen_m3 = reference.seen.volume_m3;
  const bool numbers = known_m3 > T(0) && reference.deviation_m3 >= T(0) && reference.seen.duration_s > T(0);
  if (!numbers || !(seen_m3 > T(ReferencePriors::least_seen_share) * known_m3) ||
      !(known_m3 > T(ReferencePriors::least_seen_share) * seen_m3))
    return ReferenceVerdict::not_seen;
  detail::forget(state);
  const T rated_volumes = machine.rated_flow_m3_per_s * reference.seen.duration_s / known_m3;
  const T innovation = detail::logarithm(known_m3 / seen_m3) - state.level + state.leak_share * rated_volumes;
  const T level_gain = state.level_variance - rated_volumes * state.covariance;
  const T leak_gain = state.covariance - rated_volumes * state.leak_variance;
  const T prior2 = level_gain - rated_volumes * leak_gain;
  const T chance2 = squared(reference.deviation_m3 / known_m3) + squared(T(ReferencePriors::volume_chance_share)) +
                    squared(T(ReferencePriors::volume_chance_flow_share) * rated_volumes);
  const T expected2 = prior2 + chance2;
  if (magnitude(innovation) > T(ReferencePriors::least_apart_share) &&
      squared(innovation) > squared(T(ReferencePriors::apart_deviations)) * expected2) {
    ++state.apart;
    return ReferenceVerdict::apart;
  }
  const T off2 = squared(innovation) / expected2;
  const T variance = prior2 + chance2 * (T(ReferencePriors::freedom) + off2) / T(ReferencePriors::freedom + 1);
  state.level += level_gain / variance * innovation;
  state.leak_share += leak_gain / variance * innovation;
  state.level_variance -= level_gain * level_gain / variance;
  state.covariance -= level_gain * leak_gain / variance;
  state.leak_variance -= leak_gain * leak_gain / variance;
  ++state.taken;
  return ReferenceVerdict::taken;
}

/// A reading of the spool that stands closed without current, free of drift (drift_free_m).
template <class T>
constexpr ReferenceVerdict update_closed(const MachineKnowledge<T>& machine, ReferenceState<T>& state, T reading_m) {
  constexpr T furthest_m = T(1e-4);
  const T off_m = reading_m - machine.closed_m;
  if (!(magnitude(off_m) < furthest_m)) return ReferenceVerdict::not_seen;
  constexpr int most = 100;  // the mean goes on following
  if (state.closed < most) ++state.closed;
  state.zero_m += (off_m - state.zero_m) / T(state.closed);
  return ReferenceVerdict::taken;
}

namespace detail {

/// Whether a number is above `limit` beyond doubt.
template <class T>
constexpr bool clearly(T value, T variance, T limit) {
  return value > limit && squared(value) > squared(T(ReferencePriors::finding_deviations)) * variance;
}

/// What all volumes have in common where no seal leaks: the filter's, given that leakage is none.
template <class T>
struct CommonLevel {
  T level, variance;
};
template <class T>
constexpr CommonLevel<T> without_leak(const ReferenceState<T>& state) {
  if (!(state.leak_variance > T(0))) return {state.level, state.level_variance};
  const T share = state.covariance / state.leak_variance;
  return {state.level - share * state.leak_share, state.level_variance - share * state.covariance};
}

}  // namespace detail

/// By how much a reference whose area, displacement or gain is misstated is more likely than wear, in natural
/// logarithms, where all its volumes have `level` in common, the logarithm of the machine's over the sensor's, known to
/// `variance`. Both look alike but for their size.
template <class T>
constexpr T misstated_evidence(T level, T variance) {
  const T wear2 = squared(T(ReferencePriors::volume_per_width * ReferencePriors::edge_wear)) + variance,
          loose2 = wear2 + squared(T(ReferencePriors::misstated_share));
  return T(ReferencePriors::misstated_log_odds) - detail::logarithm(T(sqrt(loose2 / wear2))) +
         T(0.5) * squared(level) * (T(1) / wear2 - T(1) / loose2);
}

/// What all references so far come to. As on the host, the volumes' level is that without a leak unless one is clear,
/// and edges of a valve whose position zero has moved need no evidence of their own: parts wear together.
template <class T>
constexpr MachineFinding<T> finding_of(const MachineKnowledge<T>& machine, const ReferenceState<T>& state) {
  constexpr T width_per_volume = T(1 / ReferencePriors::volume_per_width),
              wear2 = T(ReferencePriors::edge_wear * ReferencePriors::edge_wear);
  const T common2 = squared(machine.share_deviation) + squared(T(ReferencePriors::model_volume_share));
  const T kept = wear2 / (wear2 + squared(width_per_volume) * common2);
  const detail::CommonLevel<T> common = detail::without_leak(state);
  const T variance = common.variance + common2;
  MachineFinding<T> out{MachineVerdict::too_few, T(0), width_per_volume * sqrt(common.variance + kept * common2), T(0),
                        state.leak_share * machine.rated_flow_m3_per_s};
  const T stated_share = machine.leakage_m3_per_s / machine.rated_flow_m3_per_s;
  const bool drifted =
      state.closed > 0 &&
      squared(state.zero_m) > squared(T(ReferencePriors::finding_deviations * ReferencePriors::closed_uncertainty_m));
  const bool enough = state.taken + state.apart >= ReferencePriors::least_references;
  if (enough && T(state.apart) > T(ReferencePriors::most_left_out) * T(state.taken + state.apart)) {
    out.verdict = MachineVerdict::apart;
  } else if (enough && detail::clearly(state.leak_share, state.leak_variance, stated_share)) {
    out.verdict = MachineVerdict::leaks;
  } else if (enough && detail::clearly(-common.level, variance, T(0))) {
    out.verdict = MachineVerdict::less_oil;
  } else if (enough && common.level > T(0) &&
             misstated_evidence(common.level, variance) > T(ReferencePriors::contradiction_evidence)) {
    out.verdict = MachineVerdict::more_oil;
  } else if (drifted || (enough && detail::clearly(common.level, variance, T(0)))) {
    out.verdict = MachineVerdict::moves;
    out.position_zero_m = drifted ? state.zero_m : T(0);
    if (enough && common.level > T(0))
      out.edge_width = detail::exponential_less_one(width_per_volume * kept * common.level);
  } else if (enough) {
    out.verdict = MachineVerdict::stays;
  }
  return out;
}

}  // namespace spoolflow::sensor

#pragma once
/// The wear that makes a valve's sensor agree best with itself and with the oil that its references say has passed.
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "spoolflow/calibration/references/oil_ratios.hpp"
#include "spoolflow/calibration/references/sensor_view.hpp"
#include "spoolflow/calibration/references/wear.hpp"
#include "spoolflow/sensor/machine_reference.hpp"

namespace spoolflow::calibration {

/// As the valve itself takes references.
using Priors = sensor::ReferencePriors;
inline constexpr double edge_wear = Priors::edge_wear, position_zero_wear_m = Priors::position_zero_wear_m,
                        model_volume_share = Priors::model_volume_share,
                        closed_uncertainty_m = Priors::closed_uncertainty_m, most_left_out = Priors::most_left_out;
/// One standard deviation of what wear changes of friction between two looks at a valve.
inline constexpr double friction_wear = 0.25;
/// What one break-away counts: those of a run err alike, by what the model makes of ageing and of the edges.
inline constexpr double breakaway_weight = 0.2;
/// In natural logarithms, prior widths counted: a change is taken where it is three times as likely as none, a leak or
/// narrower edges contradict where they are five times as likely.
inline constexpr double change_evidence = 1.1, contradiction_evidence = Priors::contradiction_evidence;
/// A misstated reference is worth a doubt where it is half as likely as wear.
inline constexpr double doubtful_evidence = -0.7;
inline constexpr double percent = 100;  ///< a share of 1

/// Friction tried beside that of a look: logarithms of their ratio, -0.8 to 1.0.
inline constexpr std::size_t tried_frictions = 19, same_friction = 8;
[[nodiscard]] double tried_log_friction(std::size_t k);
using PerFriction = std::array<double, tried_frictions>;

/// What is looked at. Keeps model, recordings and references by reference.
struct MachineEvidence {
  const model::Model& model;
  std::vector<WatchedRun> runs;
  std::span<const recording::Reference> references;
  std::optional<double> closed_m;  ///< where the sensor reads closed, of `closed` references
};

/// A valve with some wear beside its evidence.
struct WearView {
  model::WearState wear;
  std::vector<OilRatio> ratios;  ///< of all intervals, run after run
  double loss;                   ///< negative logarithm of the likelihood, without constants
};

/// By how much a change of `value`, known to `deviation`, is more likely than none where wear makes it `usual` large,
/// in natural logarithms. All in one unit, one standard deviation each.
[[nodiscard]] double evidence_of_change(double value, double deviation, double usual);

/// One change, with its standard deviation, and its evidence in natural logarithms; `taken` where that suffices.
struct Change {
  double value = 0, deviation = 0, evidence = 0;
  bool taken = false;
};

/// Position zero, from the closed reading [m].
[[nodiscard]] Change position_zero_change(const MachineEvidence& evidence);

/// Sees the valve with this wear. `used` says which intervals count; empty: those that the sensor sees and that do not
/// lie apart.
[[nodiscard]] WearView seen_with(const MachineEvidence& evidence, const model::WearState& wear,
                                 const std::vector<bool>& used);

/// What all references together say of the oil beside the sensor's, logarithm of the ratio. The deviation holds their
/// own, their stated and the model's.
struct OilAgreement {
  double log_ratio, deviation;
  std::size_t references;  ///< that say it, those counted once that state one area, displacement or meter
};
[[nodiscard]] OilAgreement agreement_of(const MachineEvidence& evidence, const WearView& view);

/// Width of the edges, as the logarithm of its ratio to that of `from`. A reference whose area, displacement or gain is
/// misstated looks alike: the deviation is as large as what lies between both.
struct EdgeChange : Change {
  double asked = 0;                                             ///< what the oil asks for, no prior width counted
  double misstated = -std::numeric_limits<double>::infinity();  ///< sensor::misstated_evidence(); of several: none
  double oil = 0;                                               ///< of one reference: logarithm of its volumes' ratio
};

/// What the oil of one reference comes to. `slope`: of the oil over the width, both in logarithms.
[[nodiscard]] EdgeChange wear_or_misstated(const OilAgreement& oil, double slope);

/// Of a valve that shows other wear it needs no evidence of its own: parts wear together. Its value is below 0 where
/// the references say that less passes than forces do: then it is never taken from edges that have not widened.
[[nodiscard]] EdgeChange edge_change(const MachineEvidence& evidence, const WearView& from);

/// What one direction shows of friction in operation, for each friction tried: logarithms of the likelihoods of its
/// break-aways and of how far the references' volumes scatter beside the sensor's, with edges as wide as the oil then
/// asks for, and of what those volumes have in common. While the spool slides the sensor's own friction follows, so
/// that its innovations tell little.
struct SeenFriction {
  PerFriction with_wider_edges;  ///< edges may have widened by what is usual
  PerFriction with_these_edges;
  bool wears;  ///< the direction shows other wear
};
[[nodiscard]] SeenFriction seen_friction(const MachineEvidence& evidence, const WearView& from);

/// Friction by all directions together, for they share a spool, as the logarithm of its ratio. Its evidence is that of
/// other friction and wider edges beside none of both; of a valve that shows other wear it needs none.
[[nodiscard]] Change friction_change(std::span<const SeenFriction> seen);

}  // namespace spoolflow::calibration

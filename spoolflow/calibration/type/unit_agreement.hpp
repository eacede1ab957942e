#pragma once
/// Whether the recordings of a unit can be of one unit.
#include <string>
#include <vector>

#include "spoolflow/calibration/type/map_estimate.hpp"
#include "spoolflow/calibration/type/unit_evidence.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {

/// Sum of the squares of the standard deviations between what two recordings say of their unit, that no unit's reach:
/// chi square of sixteen directions. Sound units have 3 to 36 (sisters of valve A, eleven of three independent
/// simulations, six of the rig), recordings of two units 9 to 4400, 14 of 21 pairs more than 100.
inline constexpr double disagreeing_chi_square = 100;

/// By how much what two recordings say of a unit differs: the squares of standard deviations summed up over all
/// directions, of which it deviates most in one.
struct Disagreement {
  double chi_square;
  std::size_t variation;  ///< index into all_variations()
  double one, other;      ///< what each recording says of that
  double deviations;      ///< between them
};

/// Of what each recording alone makes of a unit that `prior` knows.
[[nodiscard]] Disagreement disagreement_of(const KnownDeviations& one, const KnownDeviations& other,
                                           const KnownDeviations& prior);

/// In words the two runs of one direction that disagree most, beyond the limit; empty: none. `type` is of that
/// direction.
[[nodiscard]] std::string disagreeing_runs(const model::Model& type, const KnownDeviations& prior,
                                           const std::vector<UnitRun>& runs);

}  // namespace spoolflow::calibration

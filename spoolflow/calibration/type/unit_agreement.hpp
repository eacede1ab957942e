#pragma once
/// Whether the recordings of a unit can be of one unit.
#include <cstddef>
#include <string>
#include <vector>

#include "spoolflow/calibration/type/map_estimate.hpp"
#include "spoolflow/calibration/type/unit_evidence.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {

/// Sum of the squares of the standard deviations between what two recordings of a minute say of their unit, that no
/// unit's reach: chi square of sixteen directions. Sound units have 3 to 114 (sisters of valve A, eleven of three
/// independent simulations, twelve of the rig), recordings of two units 9 to 4400, 23 of 48 pairs of the rig more.
inline constexpr double disagreeing_chi_square = 150;
/// Rows of evidence that a recording of a minute has at most.
inline constexpr double rows_of_a_minute = 450;
/// The same of recordings that show so many rows. What the type's maps are wrong by is alike in all rows, so that it
/// counts as often as there are more.
[[nodiscard]] double disagreeing_chi_square_of(std::size_t rows_of_one, std::size_t rows_of_other);

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

#pragma once
/// How units of a type differ, from the campaigns of several of them.
#include <string>
#include <vector>

#include "spoolflow/calibration/type/map_estimate.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::calibration {

/// Fewer units do not show how far the next one lies.
inline constexpr std::size_t least_units = 3;

/// One of the units beside the type's middle.
struct MeasuredUnit {
  std::string name;
  Deviations deviations;  ///< from the middle
  double force_left_N;    ///< root mean square of what the directions do not explain of its balance of forces
};

struct SeveralUnits {
  std::size_t nearest;   ///< to the middle: its model's tables become the type's
  Deviations middle;     ///< by what the type's middle deviates from that unit
  KnownDeviations next;  ///< the next unit about the middle: spread between units, and what is open of the middle
  std::vector<MeasuredUnit> units;
};

/// Mean and covariance of the deviations by empirical Bayes: each unit's tables of force, flux, flow and friction are
/// fitted by unit_parameters() of one of them; expectation and maximisation find middle and spread, the spread with
/// `tolerances` for prior (inverse Wishart). Rows of one table count as a few, for a bench errs alike at neighbouring
/// points. Tables do not show position zero, which keeps its tolerance. Throws CalibrationError by name: fewer than
/// `least_units`, models without the full sensor or of a whole valve or of types, of another stroke or rated flow, one
/// unit twice, or a unit further from the others than `foreign_deviations` of the tolerances.
[[nodiscard]] SeveralUnits compare_units(const std::vector<model::Model>& units, const Deviations& tolerances);

/// The type that these units are of: the tables of its middle, a band for the next unit.
[[nodiscard]] model::Model type_of(const std::vector<model::Model>& units, const SeveralUnits& compared);

struct TypeOfUnits {
  model::Model model;
  std::vector<SeveralUnits> compared;  ///< one a direction, in the order of model::directions()
};
/// Both, of whole valves for each direction by itself. `units` is not empty; throws as compare_units().
[[nodiscard]] TypeOfUnits type_of_units(const std::vector<model::Model>& units, const Deviations& tolerances);

}  // namespace spoolflow::calibration

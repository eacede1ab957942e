#pragma once
/// A series: many units of one type beside each other.
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/calibration/type/calibrate_unit.hpp"
#include "spoolflow/calibration/type/unit_population.hpp"

namespace spoolflow::calibration {

/// A unit as it was calibrated, in the order of the series.
struct SeriesUnit {
  std::string name;
  double serial;  ///< see serial_numbers()
  std::vector<UnitParameter> parameters;
  KnownDeviations known;
  double chi_square, misfit;
  std::string refusal;  ///< why it is not of the type; empty: it is
};
[[nodiscard]] SeriesUnit series_unit(const UnitCalibration& unit);

/// One direction over the series. Units that were refused count as outliers and in nothing else.
struct SeriesParameter {
  std::string name, unit;  ///< unit "1" or "m"
  double tolerance;        ///< one standard deviation, as the type has it
  double mean, spread;     ///< between units: what each one's recordings leave open is taken out of the spread
  double mean_uncertainty;
  std::size_t seen;         ///< units whose recordings show it
  double capability;        ///< Cpk against `capability_deviations` tolerances to either side; NaN: fewer than
                            ///< `least_for_capability` units, or not seen
  double drift_per_serial;  ///< slope over serial numbers; NaN: fewer than `least_for_drift` units, or not seen
  double drift_deviations;  ///< that slope over its standard uncertainty
  bool drifts;              ///< beyond `drifting_deviations`
};
/// Units at these limits, so many tolerances from the type, are at its edge.
inline constexpr double capability_deviations = marginal_deviations;
/// Of so many units Cpk is known to a third (Bissell, Applied Statistics 39, 1990); of fewer it says more of the type's
/// tolerances, which count as units, than of these.
inline constexpr std::size_t least_for_capability = 25;
inline constexpr std::size_t least_for_drift = 8;
/// Of sixteen directions without drift, one series in a hundred shows a slope beyond that in any.
inline constexpr double drifting_deviations = 4;

struct Series {
  std::string type;
  std::vector<SeriesUnit> units;            ///< by serial number
  std::vector<SeriesParameter> parameters;  ///< as all_variations()
  std::optional<Population> population;     ///< of those that are of the type, about it; none of fewer than two
  std::string direction{};                  ///< of a whole valve ", P to B" or ", P to A", for headings

  [[nodiscard]] std::size_t refused() const;
};

/// The last whole number of each name, "NG6 serial 17" being 17, where all have one and no two the same; else 1, 2, 3.
[[nodiscard]] std::vector<double> serial_numbers(const std::vector<SeriesUnit>& units);

/// Beside each other. `type`, from `file`, is the type's model that they were calibrated by. Throws CalibrationError as
/// known_of_type().
[[nodiscard]] Series compare_series(const model::Model& type, const std::string& file, std::vector<SeriesUnit> units);

/// The type as these units are: tables of their middle, their spread, with the type's own middle and
/// spread as those of `tolerances_as_units` units. Throws CalibrationError where fewer than `least_in_series` are of
/// the type.
[[nodiscard]] model::Model updated_type(const model::Model& type, const Series& series);
inline constexpr std::size_t least_in_series = 3;

}  // namespace spoolflow::calibration

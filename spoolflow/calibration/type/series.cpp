#include "spoolflow/calibration/type/series.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/numerics/covariance.hpp"
#include "spoolflow/calibration/type/spread.hpp"
#include "spoolflow/calibration/type/type_model.hpp"
#include "spoolflow/calibration/type/unit_parameters.hpp"
#include "spoolflow/numerics/equations/symmetric_equations.hpp"

namespace spoolflow::calibration {
namespace {

/// The last whole number of a name; NaN where it has none.
double number_of(std::string_view name) {
  constexpr std::string_view digits = "0123456789";
  const std::size_t last = name.find_last_of(digits);
  if (last == std::string_view::npos) return NAN;
  const std::size_t before = name.substr(0, last).find_last_not_of(digits);
  const std::size_t first = before == std::string_view::npos ? 0 : before + 1;
  double out = 0;
  for (std::size_t k = first; k <= last; ++k) out = 10 * out + (name[k] - '0');
  return out;
}

/// What the recordings say beyond the type, along the axes on which they leave less than `unseen_share` of its spread
/// open. Along the others the errors that all evidence has would count as differences between units.
UnitLikelihood beyond(const KnownDeviations& type, const KnownDeviations& unit) {
  const Eigen::MatrixXd before = inverse_of_covariance(type.covariance), after = inverse_of_covariance(unit.covariance);
  const numerics::CommonAxes axes = numerics::common_axes(after, before);
  const Eigen::VectorXd seen =
      axes.values.unaryExpr([](double ratio) { return ratio * unseen_share * unseen_share > 1 ? 1.0 : 0.0; });
  const Eigen::VectorXd gained = seen.array() * (axes.values.array() - 1);
  const Eigen::MatrixXd along = before * axes.vectors;
  const Eigen::VectorXd weighted = after * unit.mean - before * type.mean;
  return {along * gained.asDiagonal() * along.transpose(),
          along * (seen.array() * (axes.vectors.transpose() * weighted).array()).matrix()};
}

struct Slope {
  double per_serial = NAN, deviations = NAN;
};

/// Least squares line of the units' values over their serial numbers.
Slope slope_of(const std::vector<const SeriesUnit*>& units, std::size_t k) {
  const auto count = static_cast<double>(units.size());
  double mean_x = 0, mean_y = 0;
  for (const SeriesUnit* unit : units) {
    mean_x += unit->serial / count;
    mean_y += unit->parameters[k].value / count;
  }
  double xx = 0, xy = 0, yy = 0;
  for (const SeriesUnit* unit : units) {
    const double x = unit->serial - mean_x, y = unit->parameters[k].value - mean_y;
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  const double slope = xy / xx, left2 = std::max(0.0, yy - slope * xy) / (count - 2);
  return {slope, left2 > 0 ? slope / std::sqrt(left2 / xx) : 0};
}

SeriesParameter parameter_of(const Series& series, const std::vector<const SeriesUnit*>& of_type, std::size_t k,
                             const KnownDeviations& type) {
  const VariationAbout& about = all_variations()[k];
  const double tolerance = std::sqrt(type.covariance(k, k));
  SeriesParameter out{
      std::string(about.name), std::string(about.unit), tolerance, NAN, NAN, NAN, 0, NAN, NAN, NAN, false};
  out.seen = static_cast<std::size_t>(
      std::ranges::count_if(of_type, [k](const SeriesUnit* unit) { return unit->parameters[k].seen; }));
  if (!series.population || out.seen == 0) return out;
  const Population& population = *series.population;
  out.mean = population.of.mean(k);
  out.spread = std::sqrt(population.of.covariance(k, k));
  out.mean_uncertainty = std::sqrt(population.open(k, k));
  if (of_type.size() >= least_for_capability)
    out.capability = (capability_deviations * tolerance - std::abs(out.mean - type.mean(k))) / (3 * out.spread);
  if (of_type.size() < least_for_drift) return out;
  const Slope slope = slope_of(of_type, k);
  out.drift_per_serial = slope.per_serial;
  out.drift_deviations = slope.deviations;
  out.drifts = std::abs(slope.deviations) > drifting_deviations;
  return out;
}

}  // namespace

SeriesUnit series_unit(const UnitCalibration& unit) {
  return {unit.model.valve.name, NAN, unit.parameters, unit.known, unit.chi_square, unit.misfit, unit.refusal};
}

std::size_t Series::refused() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(units, [](const SeriesUnit& unit) { return !unit.refusal.empty(); }));
}

std::vector<double> serial_numbers(const std::vector<SeriesUnit>& units) {
  std::vector<double> out;
  for (const SeriesUnit& unit : units) out.push_back(number_of(unit.name));
  std::vector<double> sorted = out;
  std::ranges::sort(sorted);
  const bool each_its_own = std::ranges::none_of(out, [](double number) { return std::isnan(number); }) &&
                            std::ranges::adjacent_find(sorted) == sorted.end();
  if (each_its_own) return out;
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = static_cast<double>(k + 1);
  return out;
}

Series compare_series(const model::Model& type, const std::string& file, std::vector<SeriesUnit> units) {
  const KnownDeviations known = known_of_type(type, file);
  const std::vector<double> serials = serial_numbers(units);
  for (std::size_t k = 0; k < units.size(); ++k) units[k].serial = serials[k];
  std::ranges::sort(units, {}, &SeriesUnit::serial);
  Series out{type.type->name, std::move(units), {}, {}};
  std::vector<const SeriesUnit*> of_type;
  std::vector<UnitLikelihood> likelihoods;
  for (const SeriesUnit& unit : out.units) {
    if (!unit.refusal.empty()) continue;
    of_type.push_back(&unit);
    likelihoods.push_back(beyond(known, unit.known));
  }
  if (of_type.size() >= 2) out.population = population_of(likelihoods, known.covariance, tolerances_as_units);
  for (std::size_t k = 0; k < variations; ++k) out.parameters.push_back(parameter_of(out, of_type, k, known));
  return out;
}

model::Model updated_type(const model::Model& type, const Series& series) {
  const std::size_t of_type = series.units.size() - series.refused();
  if (of_type < least_in_series || !series.population) {
    throw CalibrationError(
        fmt::format("a type is updated from {} units of it and more, and {} of these {} are; calibrate more at once, "
                    "or leave --update-type out",
                    least_in_series, of_type, series.units.size()));
  }
  const Population& population = *series.population;
  const Eigen::MatrixXd next = population.of.covariance + population.open;
  const Deviations middle = population.of.mean, spread = next.diagonal().cwiseSqrt();
  const KnownDeviations known{Eigen::VectorXd::Zero(deviating), next};
  model::Model out = type;
  out.observer->parameters = unit_parameters(type.observer->parameters, middle);
  out.condensed.parameters = unit_parameters(type.condensed.parameters, middle);
  out.type = type_section(type.type->name, false, spread, known, type.type->environment);
  set_spread(out, type.type->environment, of_any_unit(known));
  return out;
}

}  // namespace spoolflow::calibration

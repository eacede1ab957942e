#include "spoolflow/calibration/type/several_units.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/numerics/covariance.hpp"
#include "spoolflow/calibration/type/calibrate_unit.hpp"
#include "spoolflow/calibration/type/type_model.hpp"
#include "spoolflow/calibration/type/unit_population.hpp"
#include "spoolflow/calibration/type/unit_tables.hpp"
#include "spoolflow/model/residual_of.hpp"
#include "spoolflow/numerics/equations/symmetric_equations.hpp"

namespace spoolflow::calibration {
namespace {

using Parameters = sensor::ObserverParameters<double>;

/// By a load cell or a force rig, and not inferred from the coil's coenergy.
bool newtons_measured(const model::Model& unit) {
  return std::ranges::none_of(unit.provenance.quantities, [](const model::KnownQuantity& each) {
    return each.of == model::scale_of_forces && each.how == "inferred";
  });
}

TableComparison beside(const model::Model& base, const model::Model& unit) {
  constexpr double least_N = 0.2;
  const auto left_N = [](const model::Model& of) {
    return model::residual_of(of, of.observer->residuals, model::of_axial_force).rms;
  };
  std::optional<double> balance_N;
  if (!newtons_measured(base) || !newtons_measured(unit)) balance_N = std::hypot(least_N, left_N(base), left_N(unit));
  return {base.observer->parameters, unit.observer->parameters, balance_N};
}

/// What the tables of one unit say of its deviations from the first.
UnitLikelihood likelihood_of(const TableComparison& comparison, const KnownDeviations& prior) {
  constexpr int rounds = 6, searching = 3;  // what is left before the search is no misfit
  const Eigen::MatrixXd prior_precision = inverse_of_covariance(prior.covariance);
  Eigen::VectorXd x = prior.mean;
  UnitLikelihood out;
  for (int round = 0; round < rounds; ++round) {
    const Eigen::VectorXd left = comparison.rows(x);
    Eigen::MatrixXd slope(left.size(), deviating);
    for (Eigen::Index k = 0; k < deviating; ++k) {
      constexpr double share = 0.1;
      const double step = share * std::sqrt(prior.covariance(k, k));
      Eigen::VectorXd turned = x;
      turned(k) += step;
      slope.col(k) = (comparison.rows(turned) - left) / step;
    }
    slope.col(at(Variation::position_zero)).setZero();
    const Eigen::VectorXd weights = comparison.weights(round < searching ? Eigen::VectorXd::Zero(left.size()) : left);
    out.precision = slope.transpose() * weights.asDiagonal() * slope;
    out.weighted = out.precision * x - slope.transpose() * weights.asDiagonal() * left;
    x = numerics::solve_symmetric(out.precision + prior_precision, out.weighted + prior_precision * prior.mean);
  }
  return out;
}

void require_comparable(const std::vector<model::Model>& units) {
  if (units.size() < least_units) {
    throw CalibrationError(fmt::format(
        "a type of several campaigns needs {} and more, and {} are given: two do not show how far the next unit lies; "
        "give one campaign, that of the unit nearest to the middle, and how units differ as its [tolerances]",
        least_units, units.size()));
  }
  const model::Valve& first = units.front().valve;
  for (const model::Model& unit : units) {
    if (!unit.observer || unit.whole() || unit.type) {
      throw CalibrationError(
          fmt::format("{}: a type is made of one direction's full sensor of each unit, and this is {}", unit.valve.name,
                      unit.type      ? "a type's or a unit's model already"
                      : unit.whole() ? "of both directions"
                                     : "the condensed sensor alone; record solenoid_dynamic, and axial_force_map at "
                                       "two or more oil temperatures"));
    }
    constexpr double alike = 1e-6;
    if (std::abs(unit.valve.stroke_m / first.stroke_m - 1) > alike ||
        std::abs(unit.valve.rated_flow_m3_per_s / first.rated_flow_m3_per_s - 1) > alike ||
        unit.valve.direction != first.direction) {
      throw CalibrationError(fmt::format(
          "{} and {} differ in stroke, rated flow or direction, which all units of a type have in common; correct "
          "[valve], or leave out the one that is of another type",
          first.name, unit.valve.name));
    }
  }
}

/// Two campaigns never measure the same to the last digit.
void require_each_once(const std::vector<model::Model>& units, const std::vector<Eigen::VectorXd>& found) {
  for (std::size_t k = 1; k < units.size(); ++k) {
    const auto same =
        std::find(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(k), found[k]) - found.begin();
    if (static_cast<std::size_t>(same) == k) continue;
    throw CalibrationError(fmt::format(
        "{} and {} measured the same to the last digit: the same recordings under two names show no spread; give each "
        "unit's own campaign",
        units[static_cast<std::size_t>(same)].valve.name, units[k].valve.name));
  }
}

/// A unit of another type among them, by name.
void require_one_type(const std::vector<model::Model>& units, const Population& middle, const Deviations& tolerances) {
  for (std::size_t unit = 0; unit < units.size(); ++unit) {
    for (std::size_t k = 0; k < variations; ++k) {
      double others = 0;  // a unit far out draws the mean towards itself
      for (std::size_t other = 0; other < units.size(); ++other)
        others += other == unit ? 0 : middle.units[other](k) / static_cast<double>(units.size() - 1);
      const double off = (middle.units[unit](k) - others) / tolerances[k];
      if (std::abs(off) <= foreign_deviations) continue;
      throw CalibrationError(fmt::format(
          "{} is not of one type with the others: its {} ({}) lies {:.1f} standard deviations from theirs, at most "
          "{:g}; leave it out, or give the first campaign wider [tolerances] where such units are made",
          units[unit].valve.name, all_variations()[k].name, all_variations()[k].meaning, std::abs(off),
          foreign_deviations));
    }
  }
}

/// The unit nearest to the middle, in what units differ by.
std::size_t nearest_to(const Population& middle) {
  const Eigen::MatrixXd between = inverse_of_covariance(middle.of.covariance);
  std::size_t out = 0;
  double nearest = INFINITY;
  for (std::size_t k = 0; k < middle.units.size(); ++k) {
    const Eigen::VectorXd off = middle.units[k] - middle.of.mean;
    const double distance = off.dot(between * off);
    if (distance < nearest) out = k;
    nearest = std::min(nearest, distance);
  }
  return out;
}

}  // namespace

SeveralUnits compare_units(const std::vector<model::Model>& units, const Deviations& tolerances) {
  require_comparable(units);
  const KnownDeviations prior = spread_of(tolerances);
  const auto about = [&](std::size_t base) {
    std::vector<UnitLikelihood> likelihoods;
    for (const model::Model& unit : units) likelihoods.push_back(likelihood_of(beside(units[base], unit), prior));
    return population_of(likelihoods, prior.covariance);
  };
  Population middle = about(0);
  require_each_once(units, middle.units);
  require_one_type(units, middle, tolerances);
  SeveralUnits out{nearest_to(middle), {}, {}, {}};
  if (out.nearest != 0) middle = about(out.nearest);
  out.middle = middle.of.mean;
  out.next.mean = Eigen::VectorXd::Zero(deviating);
  out.next.covariance = middle.of.covariance + middle.open;
  for (std::size_t k = 0; k < units.size(); ++k) {
    const TableComparison comparison = beside(units[out.nearest], units[k]);
    out.units.push_back({units[k].valve.name, middle.units[k] - out.middle, comparison.force_left_N(middle.units[k])});
  }
  return out;
}

model::Model type_of(const std::vector<model::Model>& units, const SeveralUnits& compared) {
  const Deviations spread = compared.next.covariance.diagonal().cwiseSqrt();
  model::Model out = units[compared.nearest];
  out.valve.name = units.front().valve.name;
  out.observer->parameters = unit_parameters(out.observer->parameters, compared.middle);
  out.condensed.parameters = unit_parameters(out.condensed.parameters, compared.middle);
  for (const model::Model& unit : units) {
    if (&unit == &units[compared.nearest]) continue;
    out.provenance.simulated = out.provenance.simulated || unit.provenance.simulated;
    const auto campaign = std::ranges::find(unit.provenance.inputs, "campaign", &model::InputFile::protocol);
    if (campaign != unit.provenance.inputs.end()) out.provenance.inputs.push_back(*campaign);
  }
  return type_model(std::move(out), spread, compared.next);
}

TypeOfUnits type_of_units(const std::vector<model::Model>& units, const Deviations& tolerances) {
  TypeOfUnits out;
  for (const std::string& direction : model::directions(units.front())) {
    std::vector<model::Model> of_one;
    for (const model::Model& unit : units) of_one.push_back(model::of_direction(unit, direction));
    out.compared.push_back(compare_units(of_one, tolerances));
    const std::size_t nearest = out.compared.back().nearest;
    model::Model type = type_of(of_one, out.compared.back());
    if (out.compared.size() == 1) {
      out.model = units[nearest];
      out.model.valve.name = type.valve.name;
      type.provenance.quantities = units[nearest].provenance.quantities;
      out.model.provenance = type.provenance;
    }
    model::put_direction(out.model, direction, std::move(type));
  }
  return out;
}

}  // namespace spoolflow::calibration

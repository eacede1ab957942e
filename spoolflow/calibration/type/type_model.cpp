#include "spoolflow/calibration/type/type_model.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/calibration/numerics/fitted_parameters.hpp"
#include "spoolflow/calibration/type/spread.hpp"
#include "spoolflow/recording/channels/allowed_names.hpp"

namespace spoolflow::calibration {
namespace {

constexpr double um_per_m = 1e6;
/// unit_parameters() is linear enough for some standard deviations of this.
constexpr double largest_share = 0.3, largest_length_m = 5e-5, largest_logarithm = 1.5;
/// No series is so much more alike, or less, than usual ones.
constexpr double usual_over_least = 200, most_over_usual = 10;

std::string key_of(const VariationAbout& about) {
  return std::string(about.name) + (about.unit == "m" ? "_um" : "");
}

std::vector<std::string> all_keys() {
  std::vector<std::string> keys;
  for (const VariationAbout& about : all_variations()) keys.push_back(key_of(about));
  return keys;
}

}  // namespace

Deviations tolerances_from(const recording::CampaignTolerances& written) {
  Deviations out{};
  for (std::size_t k = 0; k < variations; ++k) out[k] = all_variations()[k].tolerance;
  for (const auto& [key, value] : written.values) {
    const auto found = std::ranges::find(all_variations(), key, key_of);
    const auto stated = written.places.find(key);
    const std::string& place = stated == written.places.end() ? written.place : stated->second;
    if (found == all_variations().end())
      throw CalibrationError(recording::unknown_key(place, key, "[tolerances]", all_keys()));
    const bool length = found->unit == "m";
    const double scale = length ? um_per_m : 1, usual = scale * found->tolerance;
    const double linear = length                ? largest_length_m * um_per_m
                          : found->unit == "ln" ? largest_logarithm
                                                : largest_share;
    const double least = usual / usual_over_least, most = std::min(linear, most_over_usual * usual);
    if (!(value >= least && value <= most)) {
      throw CalibrationError(fmt::format(
          "{}: {} = {} is not between {:g} and {:g}; give one standard deviation between units of a type, {}", place,
          key, value, least, most,
          length                ? "in um, where it stands in mm times 1000"
          : found->unit == "ln" ? "a natural logarithm"
                                : "a share: 0.02 of 2 %"));
    }
    out[static_cast<std::size_t>(found - all_variations().begin())] = value / scale;
  }
  return out;
}

Deviations tolerances_of(const std::vector<recording::Campaign>& campaigns) {
  const recording::CampaignTolerances* written = nullptr;
  for (const recording::Campaign& campaign : campaigns) {
    if (campaign.tolerances.values.empty()) continue;
    if (written != nullptr && written->values != campaign.tolerances.values) {
      throw CalibrationError(
          fmt::format("{} and {}: [tolerances] differ, and are of the type that both belong to; state them once",
                      written->place, campaign.tolerances.place));
    }
    written = &campaign.tolerances;
  }
  return tolerances_from(written == nullptr ? recording::CampaignTolerances{} : *written);
}

model::TypeSection type_section(const std::string& type_name, bool unit, const Deviations& tolerances,
                                const KnownDeviations& known, const model::EnvironmentWithoutSpread& environment) {
  std::vector<std::string> names;
  std::vector<double> values;
  for (std::size_t k = 0; k < variations; ++k) {
    names.emplace_back(all_variations()[k].name);
    values.push_back(known.mean(k));
  }
  const model::Fit fit = known_from("deviations", names, values, known.covariance);
  model::TypeSection out{type_name, unit, {}, fit.correlation, environment};
  for (std::size_t k = 0; k < variations; ++k) {
    out.deviations.push_back(
        {names[k], std::string(all_variations()[k].unit), tolerances[k], values[k], fit.parameters[k].uncertainty});
  }
  return out;
}

void set_spread(model::Model& model, const model::EnvironmentWithoutSpread& environment, const KnownDeviations& known) {
  sensor::ObserverParameters<double>& observer = model.observer->parameters;
  const UnitSpread spread = spread_of(observer, known);
  observer.environment.force_N = std::hypot(environment.force_N, spread.force_N);
  observer.environment.friction_share = std::hypot(environment.friction_share, spread.friction_share);
  observer.environment.flow_share = std::hypot(environment.flow_share, spread.flow_share);
  observer.friction.breakaway_share = std::hypot(environment.breakaway_share, spread.breakaway_share);
}

namespace {

/// Its band is still the valve's own.
model::Model of_type(model::Model valve, const Deviations& tolerances, const KnownDeviations& units) {
  if (!valve.observer)
    throw CalibrationError(
        "a type needs the full sensor, and the campaign made the condensed one alone; record solenoid_dynamic, and "
        "axial_force_map at two or more oil temperatures");
  if (valve.type) throw CalibrationError("the model is of a type already");
  const sensor::Environment<double>& own = valve.observer->parameters.environment;
  const model::EnvironmentWithoutSpread environment{own.force_N, own.friction_share, own.flow_share,
                                                    valve.observer->parameters.friction.breakaway_share};
  valve.type = type_section(valve.valve.name, false, tolerances, units, environment);
  return valve;
}

}  // namespace

model::Model type_model(model::Model valve, const Deviations& tolerances) {
  if (valve.whole()) {
    for (const std::string& direction : model::directions(valve))
      model::put_direction(valve, direction, type_model(model::of_direction(valve, direction), tolerances));
    return valve;
  }
  const KnownDeviations units = spread_of(tolerances);
  model::Model out = of_type(std::move(valve), tolerances, units);
  const KnownDeviations sliding = sliding_with_ageing(units, out.observer->parameters.friction);
  set_spread(out, out.type->environment, of_any_unit(sliding));
  return out;
}

model::Model type_model(model::Model valve, const Deviations& tolerances, const KnownDeviations& units) {
  model::Model out = of_type(std::move(valve), tolerances, units);
  set_spread(out, out.type->environment, of_any_unit(units));
  return out;
}

KnownDeviations known_of_type(const model::Model& model, const std::string& file) {
  if (!model.type || model.type->unit || !model.observer) {
    throw CalibrationError(fmt::format(
        "{}: is the model of {}; make the type's with `spoolflow calibrate CAMPAIGN.toml --as-type -o TYPE.json`", file,
        model.type ? "one unit" : "one valve"));
  }
  const auto& deviations = model.type->deviations;
  KnownDeviations out{Eigen::VectorXd(deviating), Eigen::MatrixXd(deviating, deviating)};
  bool alike = deviations.size() == variations;
  for (std::size_t k = 0; alike && k < variations; ++k) alike = deviations[k].name == all_variations()[k].name;
  if (!alike) {
    throw CalibrationError(fmt::format(
        "{}: its type has other directions of variation than this program; make it again with --as-type", file));
  }
  for (std::size_t r = 0; r < variations; ++r) {
    out.mean(r) = deviations[r].value;
    for (std::size_t c = 0; c < variations; ++c) {
      out.covariance(r, c) =
          deviations[r].uncertainty * deviations[c].uncertainty * model.type->correlation[r * variations + c];
    }
  }
  return out;
}

}  // namespace spoolflow::calibration

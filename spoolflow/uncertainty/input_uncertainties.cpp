#include "spoolflow/uncertainty/input_uncertainties.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/model/residual_of.hpp"
#include "spoolflow/numerics/sum_of_squares.hpp"

namespace spoolflow::uncertainty {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Of a figure that may be off by a quarter of itself (JCGM 100, G.4.2).
constexpr double judged_degrees_of_freedom = 8;
/// LVDT data sheets: 0.015 % of the stroke per kelvin; of oil 20 K about the calibration's.
constexpr double drift_without_calibration = 0.00015 * 20;
constexpr double oil_away_without_calibration_K = 20;

InputUncertainty limits(InputQuantity quantity, const InstrumentFigure& figure) {
  return {quantity,           figure.value * deviation_per_half_width(Distribution::rectangular),
          Evaluation::type_b, Distribution::rectangular,
          infinite,           figure.source};
}

/// A 95 % uncertainty that the campaign states of an instrument.
InputUncertainty stated(InputQuantity quantity, double uncertainty_95) {
  return {quantity,           uncertainty_95 * deviation_per_half_width(Distribution::normal),
          Evaluation::type_b, Distribution::normal,
          infinite,           "campaign, [instruments], a 95 % uncertainty"};
}

/// Of a figure that another one already holds.
InputUncertainty contained(InputQuantity quantity) {
  return {
      quantity, 0, Evaluation::type_b, Distribution::normal, infinite, "in the campaign's figure of the instrument"};
}

bool is_default(const InstrumentFigure& figure) {
  return figure.source.starts_with("default");
}

/// Samples of one sweep hang together: one of `values` for each grid point of a sweep counts.
InputUncertainty of_residual(InputQuantity quantity, const model::Residual& residual, double values) {
  return {quantity,
          residual.rms,
          Evaluation::type_a,
          Distribution::normal,
          std::max(1.0, values - 1),
          fmt::format("model, RMS residual of the {}", residual.of)};
}

class Collection {
 public:
  Collection(const model::Model& model, const InstrumentFigures& figures, bool observer)
      : model_(model), figures_(figures), observer_(observer) {}

  Inputs collected() {
    position();
    current();
    add(limits(InputQuantity::voltage_offset, figures_.voltage_offset_V));
    oil_temperature();
    maps();
    friction();
    add(limits(InputQuantity::oil_density, figures_.oil_density));
    add(limits(InputQuantity::oil_viscosity, figures_.oil_viscosity));
    if (observer_) {
      add({InputQuantity::pressure_belief, 0, Evaluation::type_b, Distribution::normal, infinite,
           "the observer's own filter here; band_coverage_factor of its deviations are 95 %"});
    }
    if (observer_) machine();
    auto& all = inputs_.uncertainties;
    std::sort(all.begin(), all.end(),
              [](const InputUncertainty& a, const InputUncertainty& b) { return a.quantity < b.quantity; });
    return std::move(inputs_);
  }

 private:
  void add(InputUncertainty input) { inputs_.uncertainties.push_back(std::move(input)); }

  void position() {
    const auto& full = model_.observer;
    InstrumentFigure zero{drift_without_calibration * model_.valve.stroke_m,
                          "default: drift of 0.015 % of the stroke per kelvin over 20 K"};
    if (observer_) {
      zero = {full->parameters.position_sensor.backlash_m, "model, position_backlash_m"};
    } else if (full) {
      zero = {std::abs(full->parameters.position_sensor.drift_m_per_K) * oil_span_K(),
              "model, position_drift_m_per_K over its oil temperatures, which this sensor does not correct"};
    }
    const auto& campaign = model_.instruments;
    if (campaign.position_m && !figures_.position_zero_m && is_default(figures_.position_gain)) {
      add(stated(InputQuantity::position_zero, *campaign.position_m));
      add(contained(InputQuantity::position_gain));
    } else {
      add(limits(InputQuantity::position_zero, figures_.position_zero_m.value_or(zero)));
      add(limits(InputQuantity::position_gain, figures_.position_gain));
    }
    InstrumentFigure noise{full ? full->parameters.position_sensor.noise_m : 1e-6,
                           full ? "model, position_noise_m" : "default: 1 um"};
    noise = figures_.position_noise_m.value_or(noise);
    add({InputQuantity::position_noise, noise.value, Evaluation::type_a, Distribution::normal, infinite, noise.source});
  }

  void current() {
    const auto& campaign = model_.instruments;
    if (campaign.current_A && is_default(figures_.current_gain) && is_default(figures_.current_offset_A)) {
      add(contained(InputQuantity::current_gain));
      add(stated(InputQuantity::current_offset, *campaign.current_A));
    } else {
      add(limits(InputQuantity::current_gain, figures_.current_gain));
      add(limits(InputQuantity::current_offset, figures_.current_offset_A));
    }
    add({InputQuantity::current_noise, figures_.current_noise_A.value, Evaluation::type_b, Distribution::normal,
         infinite, figures_.current_noise_A.source});
  }

  void oil_temperature() {
    if (observer_ && model_.instruments.temperature_K && is_default(figures_.thermometer_K))
      return add(stated(InputQuantity::oil_temperature, *model_.instruments.temperature_K));
    if (observer_) return add(limits(InputQuantity::oil_temperature, figures_.thermometer_K));
    const InstrumentFigure away =
        model_.observer ? InstrumentFigure{oil_span_K(), "model, oil temperatures calibrated; this sensor reads none"}
                        : InstrumentFigure{oil_away_without_calibration_K, "default: 20 K about the map's temperature"};
    add(limits(InputQuantity::oil_temperature, figures_.oil_temperature_away_K.value_or(away)));
  }

  void maps() {
    const auto residual = [&](std::string_view of) -> const model::Residual& {
      return model::residual_of(model_, observer_ ? model_.observer->residuals : model_.condensed.residuals, of);
    };
    const auto sweeps = [](std::size_t loops, int points) { return 2.0 * static_cast<double>(loops) * points; };
    add(of_residual(InputQuantity::spring, residual(model::of_spring_force), sweeps(1, sensor::spring_positions)));
    as_operation_shows(inputs_.uncertainties.back());
    const double spring_N = inputs_.uncertainties.back().standard_uncertainty;
    InputUncertainty axial = of_residual(InputQuantity::flow_force_map, residual(model::of_axial_force),
                                         sweeps(model_.evidence.axial_force.size(), sensor::flow_map_positions));
    as_operation_shows(axial);
    axial.standard_uncertainty = std::hypot(axial.standard_uncertainty, spring_N);
    axial.source += " and of the spring, which is taken off it";
    add_load_cell(axial);
    if (axial.standard_uncertainty > 0 && spring_N > 0) {
      inputs_.correlations.push_back({InputQuantity::spring, InputQuantity::flow_force_map,
                                      -spring_N / axial.standard_uncertainty,
                                      "the flow-force map is the axial force less the fitted spring"});
    }
    add(std::move(axial));
    InputUncertainty magnetic = of_residual(InputQuantity::magnetic_force_map, residual(model::of_magnetic_force),
                                            sweeps(model_.evidence.magnetic_force.size(), sensor::force_map_positions));
    if (observer_) {
      const auto& actuator = model_.observer->parameters.actuator;
      magnetic.standard_uncertainty = actuator.force_uncertainty_N;
      magnetic.source = "model, magnetic_force_uncertainty_N (of the force bench's residuals)";
      as_operation_shows(magnetic);
      InputUncertainty magnetising{InputQuantity::magnetising_current,
                                   actuator.current_uncertainty_A,
                                   Evaluation::type_a,
                                   Distribution::normal,
                                   judged_degrees_of_freedom,
                                   "model, magnetising_current_uncertainty_A"};
      as_operation_shows(magnetising);
      add(std::move(magnetising));
    } else {
      add({InputQuantity::magnetic_hysteresis, deviation_per_half_width(Distribution::rectangular), Evaluation::type_b,
           Distribution::rectangular, judged_degrees_of_freedom,
           "half the width of the measured loops; where in the loop is not known"});
    }
    add_load_cell(magnetic);
    add(std::move(magnetic));
    add(of_residual(InputQuantity::flow_map, residual(model::of_flow_rate),
                    sweeps(model_.evidence.axial_force.size(), sensor::flow_map_positions)));
    for (const InputQuantity quantity : {InputQuantity::magnetic_load_cell, InputQuantity::axial_load_cell})
      add(campaign_has_force() ? contained(quantity) : limits(quantity, figures_.load_cell));
    add(limits(InputQuantity::flow_meter, figures_.flow_meter));
    if (figures_.one_load_cell) {
      inputs_.correlations.push_back({InputQuantity::magnetic_load_cell, InputQuantity::axial_load_cell, 1,
                                      "both maps were measured with one load cell"});
    }
  }

  /// The observer was run on an operating recording: its forces were found to err by that share of what the benches'
  /// residuals say (more than 1: by more).
  void as_operation_shows(InputUncertainty& forces) const {
    if (!observer_ || assumed("band_force_share")) return;
    const double share = model_.observer->parameters.band.force_share;
    forces.standard_uncertainty *= share;
    forces.source += fmt::format("; times {:.2g}, what the operating recording shows of it (band_force_share)", share);
  }

  [[nodiscard]] bool campaign_has_force() const { return model_.instruments.force_N && is_default(figures_.load_cell); }
  /// The campaign states a force in newtons: it counts in the maps that were measured with it.
  void add_load_cell(InputUncertainty& map) const {
    if (!campaign_has_force()) return;
    map.standard_uncertainty =
        std::hypot(map.standard_uncertainty, stated(map.quantity, *model_.instruments.force_N).standard_uncertainty);
    map.source += "; campaign, [instruments], load cell";
  }

  void friction() {
    if (!observer_) {
      return add({InputQuantity::friction, 1, Evaluation::type_b, Distribution::two_point, judged_degrees_of_freedom,
                  "half the width of the measured loops; this sensor does not know the direction"});
    }
    const auto& parameters = model_.observer->parameters;
    const bool assumed_share = assumed("band_friction_share");
    // What references leave open of friction stands in the machine's part, too.
    const double of_references = model::last_wear(model_.provenance).friction_share;
    InputUncertainty of_map{InputQuantity::friction,
                            numerics::with_instead(parameters.band.friction_share, of_references, 0),
                            assumed_share ? Evaluation::type_b : Evaluation::type_a,
                            Distribution::normal,
                            judged_degrees_of_freedom,
                            assumed_share ? "assumed by the model, no operating recording: band_friction_share"
                                          : "model, band_friction_share"};
    as_operation_shows(of_map);
    of_map.standard_uncertainty = std::hypot(of_map.standard_uncertainty, parameters.pressure.ratio_deviation);
    of_map.source += "; and friction_ratio_deviation";
    add(std::move(of_map));
  }

  /// What the declared machine leaves open beside the instruments (sensor/band.hpp).
  void machine() {
    const sensor::Environment<double>& open = model_.observer->parameters.environment;
    const std::array<std::pair<InputQuantity, double>, 6> declared{
        {{InputQuantity::position_zero, open.position_m},
         {InputQuantity::position_gain, open.position_share},
         {InputQuantity::current_gain, open.current_share},
         {InputQuantity::oil_temperature, open.oil_temperature_K},
         {InputQuantity::friction, open.friction_share},
         {InputQuantity::oil_density, 2 * open.flow_share}}};  // the flow goes with its root
    for (const auto& [quantity, deviation] : declared) {
      if (!(deviation > 0)) continue;
      const auto found = std::ranges::find(inputs_.uncertainties, quantity, &InputUncertainty::quantity);
      found->standard_uncertainty = std::hypot(found->standard_uncertainty, deviation);
      found->source += "; the declared machine, [environment]";
    }
  }

  /// Whether no recording showed that parameter of the observer.
  [[nodiscard]] bool assumed(std::string_view parameter) const {
    const auto& defaults = model_.observer->defaults;
    return std::find(defaults.begin(), defaults.end(), parameter) != defaults.end();
  }

  [[nodiscard]] double oil_span_K() const {
    const model::Range& range = model_.observer->oil_temperature_K;
    return 0.5 * (range.upper - range.lower);
  }

  const model::Model& model_;
  const InstrumentFigures& figures_;
  bool observer_;
  Inputs inputs_;
};

}  // namespace

Inputs inputs_of(const model::Model& model, estimation::Estimator estimator, const InstrumentFigures& figures) {
  return Collection(model, figures, estimator == estimation::Estimator::observer).collected();
}

}  // namespace spoolflow::uncertainty

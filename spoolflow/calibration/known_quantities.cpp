#include "spoolflow/calibration/known_quantities.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/calibration/fits/bench_strokes.hpp"
#include "spoolflow/model/residual_of.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::calibration {
namespace {

using Uncertainty = std::optional<double>;

/// Half width at 95 % of a fitted parameter, as a share of its value; none where no fit has it or holds it at a bound.
Uncertainty share_of(const model::Observer& observer, std::string_view parameter) {
  for (const model::Fit& fit : observer.fits) {
    const auto found = std::ranges::find(fit.parameters, parameter, &model::FittedParameter::name);
    if (found == fit.parameters.end() || found->uncertainty == 0 || found->value == 0) continue;
    return 2 * found->uncertainty / std::abs(found->value);
  }
  return {};
}

/// What of a direction's benches was recorded, and what its flow bench stands in for.
class Rows {
 public:
  Rows(const CampaignRecordings& recordings, const model::Model& model)
      : recordings_(recordings), model_(model), observer_(*model.observer), bench_(recordings.flow_bench) {
    own_map_ = !recordings.actuator_is_inferred();
    own_spring_ = bench_ == nullptr || bench_->spring_was_measured;
    own_axial_ = bench_ == nullptr || bench_->axial_force_was_measured;
  }

  void add_forces() {
    add_scale();
    add_force("magnetic force", own_map_, "solenoid_force_map", "the coil's flux linkage, and where the spool slides",
              model::of_magnetic_force);
    add_coil();
    add_force("spring force", own_spring_, "spring", "unpressurised_strokes", model::of_spring_force);
    add_force("flow force", own_axial_, "axial_force_map", "metering", model::of_axial_force);
    add_force("spool friction", own_axial_, "axial_force_map", "metering", model::of_axial_force);
  }

  void add_flow() {
    const bool by_metering = bench_ != nullptr && !bench_->axial_force_maps.empty();
    add("conductance", measured, by_metering ? "metering" : "axial_force_map", "m3/s", 2 * rms_of(model::of_flow_rate));
    const AxialForceMaps& maps = recordings_.axial_force_maps;
    if (maps.edges_are_unknown()) {
      const bool alike = std::ranges::count(observer_.defaults, model::each_edge_alone) > 0;
      add("each edge of the path", alike ? assumed : inferred,
          alike ? "both alike: A and B were joined" : "operation: A and B were joined", "1",
          share_of(observer_, "conductance_ratio_of_outlet_to_inlet"));
    }
    double lowest_K = INFINITY, highest_K = -INFINITY;
    for (const recording::Recording* map : maps.recordings()) {
      lowest_K = std::fmin(lowest_K, mean_oil_temperature_K(*map));
      highest_K = std::fmax(highest_K, mean_oil_temperature_K(*map));
    }
    const bool several = highest_K - lowest_K > 1;
    add("influence of the oil temperature", several ? measured : assumed,
        several ? fmt::format("recordings at {:.0f} to {:.0f} °C", units::degC_from_K(lowest_K),
                              units::degC_from_K(highest_K))
                : "density and viscosity: all at one oil temperature",
        "1", {});
  }

  void add_operation() {
    add_of_operation("friction at rest", "friction_ageing_ratio");
    add_of_operation("contact stiffness", "contact_stiffness_N_per_m");
    add_of_operation("backlash of the position sensor", "position_backlash_m");
    if (model_.valve.moving_mass_kg) return add("moving mass", measured, "moving_mass_g of campaign.toml", "1", {});
    add_of_operation("moving mass", "moving_mass_kg");
  }

  [[nodiscard]] std::vector<model::KnownQuantity> take() { return std::move(rows_); }

 private:
  static constexpr const char* measured = "measured";
  static constexpr const char* inferred = "inferred";
  static constexpr const char* assumed = "assumed";

  void add(std::string_view of, const char* how, std::string from, const char* unit, Uncertainty uncertainty_95) {
    rows_.push_back({model_.valve.direction, std::string(of), how, std::move(from), unit, uncertainty_95});
  }
  void add_force(const char* of, bool by_bench, const char* bench, const char* instead, std::string_view residual) {
    add(of, by_bench ? measured : inferred, by_bench ? bench : instead, "N", 2 * rms_of(residual));
  }
  [[nodiscard]] double rms_of(std::string_view residual) const {
    return model::residual_of(model_, observer_.residuals, residual).rms;
  }

  /// Newtons, which the flow does not depend on.
  void add_scale() {
    constexpr std::string_view of = model::scale_of_forces;
    if (bench_ == nullptr || own_map_)
      return add(of, measured, "load cells of the force benches", "N", model_.instruments.force_N);
    if (own_spring_ || own_axial_)
      return add(of, measured, own_axial_ ? "axial_force_map" : "spring", "1", bench_->force_scale_95);
    add(of, inferred, "coenergy of the coil, beside the momentum of the jet", "1", bench_->force_scale_95);
    add("force of the jet", assumed, "69 degrees from the spool's axis, within 3", "1", jet_force_95);
  }

  void add_coil() {
    const bool dynamic = own_map_ && !recordings_.solenoid_dynamic.empty();
    const auto& actuator = observer_.parameters.actuator;
    add("magnetic hysteresis", dynamic ? measured : inferred,
        dynamic    ? "solenoid_dynamic"
        : own_map_ ? "loops of solenoid_force_map"
                   : "moves on the flow bench",
        "A", 2 * actuator.current_uncertainty_A);
    const bool eddy_currents = dynamic || !own_map_;
    add("eddy currents",
        dynamic         ? measured
        : eddy_currents ? inferred
                        : assumed,
        dynamic         ? "solenoid_dynamic"
        : eddy_currents ? "moves on the flow bench"
                        : "none",
        "1", share_of(observer_, "classical_eddy_current_A_per_V"));
    add("armature friction", own_map_ ? measured : assumed,
        own_map_ ? "solenoid_force_map" : "none: it is counted with the spool's", "N",
        own_map_ ? Uncertainty(2 * actuator.force_uncertainty_N) : Uncertainty());
  }

  void add_of_operation(const char* of, const char* parameter) {
    const bool unknown = std::ranges::count(observer_.defaults, parameter) > 0;
    add(of, unknown ? assumed : inferred, unknown ? "as of valves of this size: no run shows it" : "operation", "1",
        unknown ? Uncertainty() : share_of(observer_, parameter));
  }

  const CampaignRecordings& recordings_;
  const model::Model& model_;
  const model::Observer& observer_;
  const EquivalentBenches* bench_;
  bool own_map_, own_spring_, own_axial_;
  std::vector<model::KnownQuantity> rows_;
};

}  // namespace

std::vector<model::KnownQuantity> known_quantities(const CampaignRecordings& recordings, const model::Model& model) {
  Rows rows(recordings, model);
  rows.add_forces();
  rows.add_flow();
  rows.add_operation();
  return rows.take();
}

}  // namespace spoolflow::calibration

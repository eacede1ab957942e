#include <ostream>

#include <nlohmann/json.hpp>

#include "spoolflow/model/describe_campaign.hpp"
#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/model/json_tables.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/model/model_limits.hpp"

namespace spoolflow::model {
namespace {

using Json = nlohmann::ordered_json;

Json range(const Range& range) {
  return Json::array({range.lower, range.upper});
}

Json provenance(const Provenance& provenance) {
  Json inputs = Json::array();
  for (const InputFile& input : provenance.inputs) {
    inputs.push_back(
        {{"protocol", input.protocol}, {"file", input.file}, {"sha256", input.sha256}, {"samples", input.samples}});
  }
  Json out{{"tool", "spoolflow " + provenance.tool_version}, {"created", provenance.created}, {"inputs", inputs}};
  for (const Adaptation& each : provenance.adaptations) {
    Json corrections = Json::array();
    for (const Correction& correction : each.corrections) {
      corrections.push_back({{"direction", correction.direction},
                             {"of", correction.of},
                             {"unit", correction.unit},
                             {"value", correction.value},
                             {"uncertainty_95", correction.uncertainty_95}});
    }
    out["adaptations"].push_back({{"tool", "spoolflow " + each.tool_version},
                                  {"created", each.created},
                                  {"adapted_from", each.adapted_from},
                                  {"files", each.files},
                                  {"corrections", corrections}});
    Json& written = out["adaptations"].back();
    if (!each.reasons.empty()) written["reasons"] = each.reasons;
    if (!each.wear) continue;
    written["wear"] = {{"edge_width", each.wear->edge_width},
                       {"friction_ratio", each.wear->friction_ratio},
                       {"position_zero_m", each.wear->position_zero_m},
                       {"flow_share", each.wear->flow_share},
                       {"friction_share", each.wear->friction_share}};
    if (!each.direction.empty()) written["direction"] = each.direction;
  }
  if (!provenance.doubts.empty()) out["doubts"] = provenance.doubts;
  for (const KnownQuantity& each : provenance.quantities) {
    Json quantity{
        {"direction", each.direction}, {"of", each.of}, {"how", each.how}, {"from", each.from}, {"unit", each.unit}};
    if (each.uncertainty_95) quantity["uncertainty_95"] = *each.uncertainty_95;
    out["quantities"].push_back(std::move(quantity));
  }
  if (provenance.simulated) out["origin"] = "simulated";
  return out;
}

Json valve(const Valve& valve) {
  Json out{{"name", valve.name}};
  describe_valve(valve, TableWriter(out));
  out["direction"] = valve.direction;
  return out;
}

Json fluid(const Fluid& fluid) {
  Json out{{"name", fluid.name}};
  describe_fluid(fluid, TableWriter(out));
  return out;
}

Json residuals(const std::vector<Residual>& residuals) {
  Json out = Json::array();
  for (const Residual& residual : residuals) {
    out.push_back({{"of", residual.of}, {"unit", residual.unit}, {"rms", residual.rms}, {"largest", residual.largest}});
  }
  return out;
}

Json instruments(const Instruments& instruments) {
  Json out = Json::object();
  describe_instruments(instruments, TableWriter(out));
  return out;
}

Json fits(const std::vector<Fit>& fits) {
  Json out = Json::array();
  for (const Fit& fit : fits) {
    Json parameters = Json::array();
    for (const FittedParameter& each : fit.parameters) {
      parameters.push_back({{"name", each.name}, {"value", each.value}, {"uncertainty", each.uncertainty}});
    }
    out.push_back({{"of", fit.of}, {"parameters", parameters}, {"correlation", fit.correlation}});
  }
  return out;
}

Json observer(const Observer& observer) {
  Json out{{"oil_temperature_range_K", range(observer.oil_temperature_K)},
           {"residuals", residuals(observer.residuals)},
           {"fits", fits(observer.fits)},
           {"defaults", observer.defaults}};
  describe_observer(observer.parameters, TableWriter(out));
  return out;
}

Json type_section(const TypeSection& type) {
  Json deviations = Json::array();
  for (const UnitDeviation& each : type.deviations) {
    deviations.push_back({{"name", each.name},
                          {"unit", each.unit},
                          {"tolerance", each.tolerance},
                          {"value", each.value},
                          {"uncertainty", each.uncertainty}});
  }
  return {{"name", type.name},
          {"of", type.unit ? "unit" : "type"},
          {"deviations", deviations},
          {"correlation", type.correlation},
          {"environment_without_spread",
           {{"force_N", type.environment.force_N},
            {"friction_share", type.environment.friction_share},
            {"flow_share", type.environment.flow_share},
            {"breakaway_share", type.environment.breakaway_share}}}};
}

Json condensed(const Condensed& condensed) {
  Json out{{"current_range_A", range(condensed.current_A)},
           {"position_range_m", range(condensed.position_m)},
           {"pressure_difference_range_Pa", range(condensed.pressure_difference_Pa)}};
  if (condensed.oil_temperature_K) out["oil_temperature_K"] = *condensed.oil_temperature_K;
  out["residuals"] = residuals(condensed.residuals);
  describe_condensed(condensed.parameters, TableWriter(out));
  return out;
}

Json map_residuals(const std::vector<MapResidual>& residuals) {
  Json out = Json::array();
  for (const MapResidual& each : residuals) {
    out.push_back({{"held", each.held},
                   {"oil_temperature_K", each.oil_temperature_K},
                   {"position_m", each.position_m},
                   {"mean_N", each.mean_N},
                   {"rms_N", each.rms_N}});
  }
  return out;
}

Json evidence(const Evidence& evidence) {
  Json magnetic = Json::array();
  for (const MagneticForceLoop& loop : evidence.magnetic_force) {
    magnetic.push_back({{"current_A", loop.current_A},
                        {"position_m", loop.position_m},
                        {"opening_N", loop.opening_N},
                        {"closing_N", loop.closing_N}});
  }
  Json axial = Json::array();
  for (const AxialForceLoop& loop : evidence.axial_force) {
    axial.push_back({{"pressure_difference_set_Pa", loop.pressure_difference_set_Pa},
                     {"position_m", loop.position_m},
                     {"opening_N", loop.opening_N},
                     {"closing_N", loop.closing_N},
                     {"flow_m3_per_s", loop.flow_m3_per_s},
                     {"pressure_difference_Pa", loop.pressure_difference_Pa}});
  }
  Json solenoid = Json::array();
  for (const SolenoidTrace& trace : evidence.bench.solenoid) {
    solenoid.push_back({{"test", trace.test},
                        {"position_m", trace.position_m},
                        {"current_A", trace.current_A},
                        {"measured_N", trace.measured_N},
                        {"model_N", trace.model_N},
                        {"map_N", trace.map_N}});
  }
  return {{"magnetic_force_loops", magnetic},
          {"axial_force_loops", axial},
          {"solenoid_traces", solenoid},
          {"magnetic_force_residuals", map_residuals(evidence.bench.magnetic_force)},
          {"axial_force_residuals", map_residuals(evidence.bench.axial_force)},
          {"sensitivity",
           {{"position_m", evidence.sensitivity.position_m},
            {"pressure_difference_Pa", evidence.sensitivity.pressure_difference_Pa},
            {"flow_per_force_m3_per_s_N", evidence.sensitivity.flow_per_force_m3_per_s_N}}},
          {"uniqueness",
           {{"unique_from_m", evidence.uniqueness.unique_from_m},
            {"blind_below_m", evidence.uniqueness.blind_below_m},
            {"ambiguous_at_m", evidence.uniqueness.ambiguous_at_m}}}};
}

}  // namespace

void write_model(std::ostream& out, const Model& model) {
  require_limits(model, "the model to be written");
  Json file{{"format", "spoolflow model"},
            {"version", model_version},
            {"valve", valve(model.valve)},
            {"fluid", fluid(model.fluid)}};
  if (Json given = instruments(model.instruments); !given.empty()) file["instruments"] = std::move(given);
  file["provenance"] = provenance(model.provenance);
  file["condensed"] = condensed(model.condensed);
  if (model.observer) file["observer"] = observer(*model.observer);
  if (model.type) file["type"] = type_section(*model.type);
  file["evidence"] = evidence(model.evidence);
  if (model.p_to_a) {
    Json& p_to_a = file["p_to_a"] = {{"condensed", condensed(model.p_to_a->condensed)}};
    if (model.p_to_a->observer) p_to_a["observer"] = observer(*model.p_to_a->observer);
    if (model.p_to_a->type) p_to_a["type"] = type_section(*model.p_to_a->type);
    p_to_a["evidence"] = evidence(model.p_to_a->evidence);
  }
  out << file.dump(1) << '\n';
}

}  // namespace spoolflow::model

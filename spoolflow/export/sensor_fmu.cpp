#include "spoolflow/export/sensor_fmu.hpp"

#include <fmt/format.h>

#include "spoolflow/export/embedded_files.hpp"
#include "spoolflow/export/fmu/sensor_numbers.hpp"
#include "spoolflow/export/fmu/sensor_variables.hpp"
#include "spoolflow/export/fmu_archive.hpp"
#include "spoolflow/export/xml_text.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::exports {
namespace {

template <class Parameters>
void fill(FmuContent& content, const model::Valve& valve, const Parameters& parameters, std::string_view estimator) {
  content.resource.kind = fmu::order_of<Parameters>(estimator);
  content.resource.numbers = {valve.rated_flow_m3_per_s, valve.stroke_m};
  const std::vector<double> numbers = fmu::numbers_of(parameters);
  content.resource.numbers.insert(content.resource.numbers.end(), numbers.begin(), numbers.end());
  Parameters tuned = parameters;
  content.variables = fmu::sensor_variables({valve.rated_flow_m3_per_s, valve.stroke_m, valve.direction == "both"},
                                            fmu::tunable_numbers(tuned));
}

void fill_from(FmuContent& content, const model::Model& model) {
  if (!model.whole() && model.has_observer()) {
    fill(content, model.valve, model.observer->parameters, "observer");
  } else if (!model.whole()) {
    fill(content, model.valve, model.condensed.parameters, "condensed");
  } else if (model.has_observer()) {
    const fmu::BothDirections<sensor::ObserverParameters<double>> both{model.observer->parameters,
                                                                       model.p_to_a->observer->parameters};
    fill(content, model.valve, both, "observer of both directions");
  } else {
    const fmu::BothDirections<sensor::CondensedParameters<double>> both{model.condensed.parameters,
                                                                        model.p_to_a->condensed.parameters};
    fill(content, model.valve, both, "condensed of both directions");
  }
}

/// What the signs of a whole valve mean; of one direction the variables say all.
std::string notes_on_signs(const model::Model& model) {
  if (!model.whole()) return "";
  return "<p>The whole 4/3 valve: solenoid b opens P to B, solenoid a opens P to A. Position counts from the centre, "
         "and "
         "flow is &gt; 0 from P to B, &lt; 0 from P to A; so are the forces. The pressure difference is that of the "
         "path that is open. Parameters that begin with b. or a. belong to one direction.</p>\n";
}

std::string notes(const model::Model& model, std::string_view estimator) {
  std::string bits;
  for (const sensor::StatusName& entry : sensor::status_names) {
    bits += fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", static_cast<std::uint32_t>(entry.bit), entry.name);
  }
  return fmt::format(
      "<p>Valve: {}, full scale {:.4g} L/min, stroke {:.4g} mm, oil {}. Calibrated by spoolflow {} on {}. Estimator: "
      "{}.</p>\n{}"
      "<p>Inputs may be NaN: without current or position the last flow is held with a band that opens, and status says "
      "sample_missing; the "
      "sensor recovers with the next complete sample. Where voltage or oil temperature are not measured, set "
      "use_voltage or "
      "use_oil_temperature to false.</p>\n"
      "<h2>Status</h2>\n<p>The sum of these bits; from 65536 on they are faults.</p>\n<table>\n{}</table>\n",
      xml_text(model.valve.name), model.valve.rated_flow_m3_per_s * units::litre_per_minute_per_m3_per_s,
      model.valve.stroke_m * units::millimetre_per_metre, xml_text(model.fluid.name),
      xml_text(model.provenance.tool_version), xml_text(model.provenance.created), estimator, notes_on_signs(model),
      bits);
}

}  // namespace

FmuContent sensor_fmu_content(const model::Model& model, std::string_view tool_version) {
  const char* const estimator = model.has_observer() ? "observer" : "condensed";
  FmuContent content;
  content.identifier = "spoolflow_sensor";
  content.model_name = "spoolflow sensor of " + model.valve.name;
  content.description = fmt::format(
      "Soft flow-rate sensor of a {} ({}): flow with its 95 % band from coil current, coil voltage, spool position and "
      "oil temperature",
      model.whole() ? "whole 4/3 valve" : "spool valve", estimator);
  content.notes_html = notes(model, estimator);
  content.tool_version = tool_version;
  content.generation_time = model::creation_time();
  content.resource.name = model.valve.name;
  fill_from(content, model);
  content.sources = translation_units(sensor_fmu_sources());
  return content;
}

std::string sensor_fmu(const model::Model& model, FmiVersion version, std::string_view tool_version) {
  return fmu_archive(sensor_fmu_content(model, tool_version), "sensor_fmu", sensor_fmu_sources(), version);
}

}  // namespace spoolflow::exports

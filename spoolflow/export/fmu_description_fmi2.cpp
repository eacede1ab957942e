/// modelDescription.xml by FMI 2.0.
#include <fmt/format.h>

#include "spoolflow/export/fmu/number_text.hpp"
#include "spoolflow/export/fmu_content.hpp"
#include "spoolflow/export/fmu_words.hpp"
#include "spoolflow/export/xml_text.hpp"

namespace spoolflow::exports {
namespace {

using fmu::Causality;
using fmu::number_text;
using fmu::Type;
using fmu::Variable;

/// The element that holds type, unit, range and start value.
std::string typed(const Variable& variable) {
  const bool has_start = variable.causality == Causality::parameter || variable.causality == Causality::input;
  if (variable.type == Type::boolean) {
    return has_start ? fmt::format("<Boolean start=\"{}\"/>", variable.start != 0 ? "true" : "false") : "<Boolean/>";
  }
  std::string out = variable.type == Type::real ? "<Real" : "<Integer";
  if (!variable.unit.empty()) out += fmt::format(" unit=\"{}\"", variable.unit);
  if (!variable.display_unit.empty()) out += fmt::format(" displayUnit=\"{}\"", variable.display_unit);
  out += limits(variable);
  if (variable.derivative_of >= 0) out += fmt::format(" derivative=\"{}\"", variable.derivative_of + 1);
  if (has_start) out += fmt::format(" start=\"{}\"", number_text(variable.start));
  return out + "/>";
}

std::string scalar_variable(const Variable& variable, std::size_t reference) {
  return fmt::format(
      "    <ScalarVariable name=\"{}\" valueReference=\"{}\" description=\"{}\" causality=\"{}\" "
      "variability=\"{}\"{}>\n"
      "      {}\n"
      "    </ScalarVariable>\n",
      variable.name, reference, xml_text(variable.description), word(variable.causality), word(variable.variability),
      initial(variable), typed(variable));
}

/// Outputs, or those that are derivatives, by their place among the variables, from 1, with what else is said of each.
std::string outputs(const std::vector<Variable>& variables, std::string_view more, bool derivatives = false) {
  std::string out;
  for (std::size_t k = 0; k < variables.size(); ++k) {
    if (derivatives ? variables[k].derivative_of >= 0 : variables[k].causality == Causality::output)
      out += fmt::format("      <Unknown index=\"{}\"{}/>\n", k + 1, more);
  }
  return out;
}

/// An output answers what was set a step ago: none depends on an input of its own instant.
constexpr std::string_view no_feedthrough = " dependencies=\"\"";

}  // namespace

std::string model_description_fmi2(const FmuContent& content) {
  std::string files, variables;
  for (const std::string& source : content.sources) files += fmt::format("      <File name=\"{}\"/>\n", source);
  for (std::size_t k = 0; k < content.variables.size(); ++k) variables += scalar_variable(content.variables[k], k);
  const std::string unknowns = outputs(content.variables, no_feedthrough);
  std::string derivatives = outputs(content.variables, no_feedthrough, true);
  if (!derivatives.empty()) derivatives = "    <Derivatives>\n" + derivatives + "    </Derivatives>\n";
  const std::string initial_unknowns = outputs(content.variables, "");
  return fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="{}" guid="{}" description="{}" license="Apache-2.0" generationTool="spoolflow {}" generationDateAndTime="{}" variableNamingConvention="structured" numberOfEventIndicators="0">
  <CoSimulation modelIdentifier="{}" needsExecutionTool="false" canHandleVariableCommunicationStepSize="true" canInterpolateInputs="false" maxOutputDerivativeOrder="0" canRunAsynchronuously="false" canBeInstantiatedOnlyOncePerProcess="false" canNotUseMemoryManagementFunctions="true" canGetAndSetFMUstate="true" canSerializeFMUstate="true" providesDirectionalDerivative="false">
    <SourceFiles>
{}    </SourceFiles>
  </CoSimulation>
{}  <LogCategories>
{}  </LogCategories>
  <DefaultExperiment startTime="0" stopTime="{}" stepSize="{}"/>
  <ModelVariables>
{}  </ModelVariables>
  <ModelStructure>
    <Outputs>
{}    </Outputs>
{}    <InitialUnknowns>
{}    </InitialUnknowns>
  </ModelStructure>
</fmiModelDescription>
)",
      xml_text(content.model_name), content.resource.token, xml_text(content.description), content.tool_version,
      content.generation_time, content.identifier, files, unit_definitions(content.variables), log_categories(),
      number_text(content.stop_s), number_text(content.step_s), variables, unknowns, derivatives, initial_unknowns);
}

}  // namespace spoolflow::exports

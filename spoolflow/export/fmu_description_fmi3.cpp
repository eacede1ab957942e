/// modelDescription.xml and buildDescription.xml by FMI 3.0.
#include <array>

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

const char* element(Type type) {
  static constexpr std::array elements{"Float64", "Int32", "Boolean"};
  return elements.at(static_cast<std::size_t>(type));
}

std::string start(const Variable& variable) {
  if (variable.causality != Causality::parameter && variable.causality != Causality::input) return {};
  if (variable.type == Type::boolean) return variable.start != 0 ? " start=\"true\"" : " start=\"false\"";
  return fmt::format(" start=\"{}\"", number_text(variable.start));
}

std::string variable_element(const Variable& variable, std::size_t reference) {
  std::string out =
      fmt::format("    <{} name=\"{}\" valueReference=\"{}\" description=\"{}\" causality=\"{}\" variability=\"{}\"{}",
                  element(variable.type), variable.name, reference, xml_text(variable.description),
                  word(variable.causality), word(variable.variability), initial(variable));
  if (!variable.unit.empty()) out += fmt::format(" unit=\"{}\"", variable.unit);
  if (!variable.display_unit.empty()) out += fmt::format(" displayUnit=\"{}\"", variable.display_unit);
  if (variable.type != Type::boolean) out += limits(variable);
  if (variable.derivative_of >= 0) out += fmt::format(" derivative=\"{}\"", variable.derivative_of);
  return out + start(variable) + "/>\n";
}

}  // namespace

std::string model_description_fmi3(const FmuContent& content) {
  std::string variables, outputs, derivatives, initial_unknowns;
  for (std::size_t k = 0; k < content.variables.size(); ++k) {
    variables += variable_element(content.variables[k], k);
    if (content.variables[k].causality != Causality::output) continue;
    // An output answers what was set a step ago: none depends on an input of its own instant.
    outputs += fmt::format("    <Output valueReference=\"{}\" dependencies=\"\"/>\n", k);
    if (content.variables[k].derivative_of >= 0)
      derivatives += fmt::format("    <ContinuousStateDerivative valueReference=\"{}\" dependencies=\"\"/>\n", k);
    initial_unknowns += fmt::format("    <InitialUnknown valueReference=\"{}\"/>\n", k);
  }
  return fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="{}" instantiationToken="{}" description="{}" license="Apache-2.0" generationTool="spoolflow {}" generationDateAndTime="{}" variableNamingConvention="structured">
  <CoSimulation modelIdentifier="{}" needsExecutionTool="false" canBeInstantiatedOnlyOncePerProcess="false" canGetAndSetFMUState="true" canSerializeFMUState="true" providesDirectionalDerivatives="false" providesAdjointDerivatives="false" providesPerElementDependencies="false" canHandleVariableCommunicationStepSize="true" maxOutputDerivativeOrder="0" recommendedIntermediateInputSmoothness="0" providesIntermediateUpdate="false" mightReturnEarlyFromDoStep="false" canReturnEarlyAfterIntermediateUpdate="false" hasEventMode="false" providesEvaluateDiscreteStates="false"/>
{}  <LogCategories>
{}  </LogCategories>
  <DefaultExperiment startTime="0" stopTime="{}" stepSize="{}"/>
  <ModelVariables>
{}  </ModelVariables>
  <ModelStructure>
{}{}{}  </ModelStructure>
</fmiModelDescription>
)",
      xml_text(content.model_name), content.resource.token, xml_text(content.description), content.tool_version,
      content.generation_time, content.identifier, unit_definitions(content.variables), log_categories(),
      number_text(content.stop_s), number_text(content.step_s), variables, outputs, derivatives, initial_unknowns);
}

std::string build_description(const FmuContent& content) {
  std::string files;
  for (const std::string& source : content.sources) files += fmt::format("      <SourceFile name=\"{}\"/>\n", source);
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
<fmiBuildDescription fmiVersion="3.0">
  <BuildConfiguration modelIdentifier="{}">
    <SourceFileSet language="C++20">
{}      <IncludeDirectory name="."/>
    </SourceFileSet>
  </BuildConfiguration>
</fmiBuildDescription>
)",
                     content.identifier, files);
}

}  // namespace spoolflow::exports

#include "spoolflow/export/valve_fmu.hpp"

#include <array>

#include <fmt/format.h>

#include "spoolflow/export/embedded_files.hpp"
#include "spoolflow/export/fmu/valve_numbers.hpp"
#include "spoolflow/export/fmu/valve_variables.hpp"
#include "spoolflow/export/fmu_archive.hpp"
#include "spoolflow/export/xml_text.hpp"
#include "spoolflow/model/provenance.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::exports {
namespace {

const char* load_name(rig::LoadKind kind) {
  static constexpr std::array names{
      "a bench that holds the pressure difference over the open edge",
      "an orifice between the ports",
      "a differential cylinder",
      "a hydraulic motor with its inertia",
      "a bench that joins the ports and holds the pressure difference over the open path",
      "a bench that feeds port A and holds the pressure difference over the edge to tank"};
  return names.at(static_cast<std::size_t>(kind));
}

std::string notes(const rig::ValveUnderTest& valve) {
  return fmt::format(
      "<p>Valve: {}, full scale {:.4g} L/min, stroke {:.4g} mm, oil {}. Load: {}. It is simulated; the simulation "
      "shares no "
      "physics with the sensor.</p>\n"
      "<p>Outputs current, voltage, position and oil_temperature are what the valve's electronics measure, and connect "
      "to "
      "the inputs of the same names of the sensor's FMU; the other outputs are true values that no instrument shows. "
      "The valve "
      "steps every 0.1 ms; a communication step that is no multiple of it ends at the next one. An input that is NaN "
      "or outside its range is refused: the step is discarded.</p>\n",
      xml_text(valve.name), valve.rating.flow_L_per_min, valve.plant.spool.stroke_m * units::millimetre_per_metre,
      xml_text(valve.fluid), load_name(valve.plant.load.kind));
}

}  // namespace

FmuContent valve_fmu_content(const rig::ValveUnderTest& valve, std::string_view tool_version) {
  const rig::ValveUnderTest built = rig::as_built(valve);
  const fmu::VirtualValve inside{built.plant, built.electronics, built.instruments};
  const double rated_flow_m3_per_s = units::m3_per_s_from_L_per_min(built.rating.flow_L_per_min);
  FmuContent content;
  content.identifier = "spoolflow_valve";
  content.model_name = "virtual valve " + built.name;
  content.description =
      "A 4/3 proportional spool valve with its electronics on a virtual test rig: signals and true values";
  content.notes_html = notes(built);
  content.tool_version = tool_version;
  content.generation_time = model::creation_time();
  content.variables = fmu::valve_variables(inside, rated_flow_m3_per_s);
  content.resource.kind = fmu::valve_order();
  content.resource.name = built.name;
  content.resource.numbers = {rated_flow_m3_per_s};
  const std::vector<double> numbers = fmu::numbers_of(inside);
  content.resource.numbers.insert(content.resource.numbers.end(), numbers.begin(), numbers.end());
  content.sources = translation_units(valve_fmu_sources());
  return content;
}

std::string valve_fmu(const rig::ValveUnderTest& valve, FmiVersion version, std::string_view tool_version) {
  return fmu_archive(valve_fmu_content(valve, tool_version), "valve_fmu", valve_fmu_sources(), version);
}

SystemPackage& system_package() {
  static SystemPackage of_the_program;
  return of_the_program;
}

}  // namespace spoolflow::exports

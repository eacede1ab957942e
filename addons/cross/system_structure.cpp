#include "addons/cross/system_structure.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/export/fmu/number_text.hpp"
#include "spoolflow/export/fmu_words.hpp"
#include "spoolflow/export/xml_text.hpp"
#include "spoolflow/export/zip_archive.hpp"

namespace spoolflow::exports {
namespace {

using fmu::Causality;
using fmu::Variable;

std::string type_of(const Variable& variable) {
  if (variable.type == fmu::Type::boolean) return "<ssc:Boolean/>";
  if (variable.type == fmu::Type::integer) return "<ssc:Integer/>";
  return fmt::format("<ssc:Real unit=\"{}\"/>", variable.unit);
}

std::string connector(const Variable& variable, const std::string& name) {
  return fmt::format("<ssd:Connector name=\"{}\" kind=\"{}\" description=\"{}\">{}</ssd:Connector>\n", name,
                     word(variable.causality), xml_text(variable.description), type_of(variable));
}

bool connects(const Variable& variable) {
  return variable.causality == Causality::input || variable.causality == Causality::output;
}

/// A connection's ends; without an element: of the system itself.
struct End {
  const char* element;
  std::string connector;
};
std::string connection(const End& start, const End& end) {
  const auto element = [](const char* which, const End& at) {
    return at.element[0] == 0 ? std::string() : fmt::format(" {}Element=\"{}\"", which, at.element);
  };
  return fmt::format("      <ssd:Connection{} startConnector=\"{}\"{} endConnector=\"{}\"/>\n", element("start", start),
                     start.connector, element("end", end), end.connector);
}

struct Wiring {
  std::string connectors;  ///< of the system
  std::string connections;
  std::set<std::pair<std::string, std::string>> driven{};  ///< elements' inputs at which connections end
  void connect(const End& start, const End& end) {
    connections += connection(start, end);
    driven.emplace(end.element, end.connector);
  }
};

/// Of its inputs those alone that are connected: what stands here and gets no value is zero to some tools, in the place
/// of the FMU's own start value.
std::string component(const char* name, const std::vector<Variable>& variables, const Wiring& wires) {
  std::string connectors;
  for (const Variable& variable : variables) {
    const bool driven = variable.causality != Causality::input || wires.driven.count({name, variable.name}) > 0;
    if (connects(variable) && driven) connectors += "          " + connector(variable, variable.name);
  }
  return fmt::format(
      "      <ssd:Component name=\"{0}\" type=\"application/x-fmu-sharedlibrary\" source=\"resources/{0}.fmu\">\n"
      "        <ssd:Connectors>\n{1}        </ssd:Connectors>\n      </ssd:Component>\n",
      name, connectors);
}

Wiring wiring(const std::vector<Variable>& sensor, const std::vector<Variable>& valve) {
  Wiring out;
  for (const Variable& set : valve) {
    if (set.name != "position_set" && set.name != "pressure_difference_set") continue;
    out.connectors += "      " + connector(set, set.name);
    out.connect({"", set.name}, {"valve", set.name});
  }
  for (const Variable& own : sensor) {
    const bool measured = std::any_of(valve.begin(), valve.end(), [&](const Variable& other) {
      return own.causality == Causality::input && other.causality == Causality::output && other.name == own.name &&
             other.unit == own.unit;
    });
    if (measured) out.connect({"valve", own.name}, {"sensor", own.name});
    if (own.causality != Causality::output) continue;
    out.connectors += "      " + connector(own, own.name);
    out.connect({"sensor", own.name}, {"", own.name});
  }
  for (const Variable& truth : valve) {
    if (truth.name != "flow" && truth.name != "pressure_difference") continue;
    out.connectors += "      " + connector(truth, "true_" + truth.name);
    out.connect({"valve", truth.name}, {"", "true_" + truth.name});
  }
  return out;
}

std::string units_of(const std::vector<Variable>& sensor, const std::vector<Variable>& valve) {
  std::set<std::string> used;
  for (const auto* variables : {&sensor, &valve}) {
    for (const Variable& variable : *variables) {
      if (connects(variable) && !variable.unit.empty()) used.insert(variable.unit);
    }
  }
  std::string out;
  for (const std::string& unit : used)
    out += fmt::format("    <ssc:Unit name=\"{}\"><ssc:BaseUnit{}/></ssc:Unit>\n", unit, base_unit(unit));
  return out;
}

std::string system_structure(const FmuContent& sensor, const FmuContent& valve) {
  const Wiring wires = wiring(sensor.variables, valve.variables);
  return fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon" xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription" version="1.0" name="{} beside {}" generationTool="spoolflow {}" generationDateAndTime="{}">
  <ssd:System name="valve_and_sensor">
    <ssd:Connectors>
{}    </ssd:Connectors>
    <ssd:Elements>
{}{}    </ssd:Elements>
    <ssd:Connections>
{}    </ssd:Connections>
  </ssd:System>
  <ssd:Units>
{}  </ssd:Units>
  <ssd:DefaultExperiment startTime="0" stopTime="{}"/>
</ssd:SystemStructureDescription>
)",
      xml_text(sensor.model_name), xml_text(valve.model_name), sensor.tool_version, sensor.generation_time,
      wires.connectors, component("valve", valve.variables, wires), component("sensor", sensor.variables, wires),
      wires.connections, units_of(sensor.variables, valve.variables), fmu::number_text(sensor.stop_s));
}

}  // namespace

std::string valve_and_sensor(const model::Model& model, const rig::ValveUnderTest& valve, FmiVersion version,
                             std::string_view tool_version) {
  return zip_archive({{"SystemStructure.ssd", system_structure(sensor_fmu_content(model, tool_version),
                                                               valve_fmu_content(valve, tool_version))},
                      {"resources/sensor.fmu", sensor_fmu(model, version, tool_version)},
                      {"resources/valve.fmu", valve_fmu(valve, version, tool_version)}},
                     model::creation_seconds());
}

}  // namespace spoolflow::exports

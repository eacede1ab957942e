#include "tests/fmu/description_rules.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>

#include <fmt/format.h>

namespace spoolflow::exports {
namespace {

using Violations = std::vector<std::string>;

bool in(const XmlElement& element, const std::string& attribute, const std::set<std::string>& allowed) {
  return element.has(attribute) && allowed.contains(element[attribute]);
}

double number(const XmlElement& element, const std::string& attribute) {
  return std::stod(element[attribute]);
}

void check_root(const UnpackedFmu& fmu, Violations& out) {
  const XmlElement& root = fmu.description().front();
  const bool fmi2 = fmu.version() == FmiVersion::fmi2;
  if (root.name != "fmiModelDescription") out.push_back("the root is " + root.name);
  for (const char* required : {"fmiVersion", "modelName", "generationTool", "generationDateAndTime"}) {
    if (!root.has(required) || root[required].empty()) out.push_back(std::string("no ") + required);
  }
  static const std::regex date(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ)");
  if (!std::regex_match(root["generationDateAndTime"], date))
    out.push_back("generationDateAndTime is no UTC xs:dateTime");
  static const std::regex token(R"(\{[0-9a-f]{8}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{4}-[0-9a-f]{12}\})");
  if (!std::regex_match(fmu.token(), token)) out.push_back("the token is " + fmu.token());
  // The order of the parts is the schema's.
  const Violations order{"CoSimulation",      "UnitDefinitions", "LogCategories",
                         "DefaultExperiment", "ModelVariables",  "ModelStructure"};
  Violations found;
  for (const XmlElement& element : fmu.description()) {
    if (element.path == "fmiModelDescription/" + element.name) found.push_back(element.name);
  }
  if (found != order) out.push_back("the parts of the description are not in the schema's order");

  const XmlElement& kind = fmu.description().at(1);
  static const std::regex identifier("[A-Za-z_][A-Za-z0-9_]*");
  if (!std::regex_match(kind["modelIdentifier"], identifier)) out.push_back("modelIdentifier is no C identifier");
  const std::string can = fmi2 ? "state" : "State";
  for (const std::string& yes :
       Violations{"canHandleVariableCommunicationStepSize", "canGetAndSetFMU" + can, "canSerializeFMU" + can}) {
    if (!in(kind, yes, {"true"})) out.push_back(yes + " is not true");
  }
  if (!in(kind, "canBeInstantiatedOnlyOncePerProcess", {"false"})) out.push_back("one instance a process only");
  if (!in(kind, "needsExecutionTool", {"false"})) out.push_back("needs a tool");
}

void check_units(const UnpackedFmu& fmu, Violations& out) {
  std::map<std::string, std::set<std::string>> units;
  std::string unit;
  for (const XmlElement& element : fmu.description()) {
    if (element.name == "Unit") {
      unit = element["name"];
      if (!units.emplace(unit, std::set<std::string>()).second) out.push_back("unit defined twice: " + unit);
    }
    if (element.name == "DisplayUnit" && !units[unit].insert(element["name"]).second) {
      out.push_back("display unit defined twice: " + element["name"]);
    }
  }
  std::set<std::string> used;
  for (const XmlElement& variable : fmu.variables()) {
    if (variable.has("unit")) used.insert(variable["unit"]);
    if (variable.has("unit") && !units.contains(variable["unit"])) out.push_back("undefined unit " + variable["unit"]);
    if (variable.has("displayUnit") &&
        !(variable.has("unit") && units[variable["unit"]].contains(variable["displayUnit"]))) {
      out.push_back("undefined display unit " + variable["displayUnit"]);
    }
    if ((variable["type"] == "Real" || variable["type"] == "Float64") && !variable.has("unit")) {
      out.push_back(variable["name"] + " has no unit");
    }
  }
  for (const auto& [name, display] : units) {
    if (!used.contains(name)) out.push_back("unit " + name + " is not used");
  }
}

/// FMI 2.0 section 2.2.7, FMI 3.0 section 2.4.7.4: which combinations there are, who has a start value.
void check_variable(const XmlElement& variable, bool fmi2, Violations& out) {
  const std::string& name = variable["name"];
  const std::string& causality = variable["causality"];
  const std::string& variability = variable["variability"];
  const bool real = variable["type"] == "Real" || variable["type"] == "Float64";
  const std::map<std::string, std::set<std::string>> combinations{{"independent", {"continuous"}},
                                                                  {"parameter", {"fixed", "tunable"}},
                                                                  {"input", {"discrete", "continuous"}},
                                                                  {"output", {"constant", "discrete", "continuous"}}};
  if (!combinations.contains(causality) || !combinations.at(causality).contains(variability)) {
    out.push_back(fmt::format("{}: {} {} is no combination", name, variability, causality));
  }
  if (!real && variability == "continuous") out.push_back(name + ": only real variables are continuous");
  const std::string initial = variable.has("initial") ? variable["initial"] : "";
  const std::string wanted = causality == "parameter" ? "exact" : causality == "output" ? "calculated" : "";
  if (initial != wanted) out.push_back(fmt::format("{}: initial is '{}', not '{}'", name, initial, wanted));
  const bool wants_start = causality == "parameter" || causality == "input";
  if (variable.has("start") != wants_start) out.push_back(name + (wants_start ? ": no start" : ": a start"));
  if (variable.has("min") && variable.has("max") && !(number(variable, "min") <= number(variable, "max"))) {
    out.push_back(name + ": min is above max");
  }
  if (variable.has("start") && variable.has("min") && variable["type"] != "Boolean" &&
      !(number(variable, "min") <= number(variable, "start") && number(variable, "start") <= number(variable, "max"))) {
    out.push_back(name + ": the start value is out of range");
  }
  if (variable.has("nominal") && !(number(variable, "nominal") > 0)) out.push_back(name + ": nominal is not above 0");
  static const std::regex structured(R"([A-Za-z_]\w*(\.[A-Za-z_]\w*)*)");
  if (!std::regex_match(name, structured)) out.push_back(name + ": no structured name");
  if (!variable.has("description") || variable["description"].empty()) out.push_back(name + ": no description");
  const std::set<std::string> types =
      fmi2 ? std::set<std::string>{"Real", "Integer", "Boolean"} : std::set<std::string>{"Float64", "Int32", "Boolean"};
  if (!types.contains(variable["type"])) out.push_back(name + ": type " + variable["type"]);
}

void check_variables(const UnpackedFmu& fmu, Violations& out) {
  std::set<std::string> names, references;
  int independent = 0;
  for (const XmlElement& variable : fmu.variables()) {
    check_variable(variable, fmu.version() == FmiVersion::fmi2, out);
    if (!names.insert(variable["name"]).second) out.push_back("name twice: " + variable["name"]);
    if (!references.insert(variable["valueReference"]).second) out.push_back("reference twice: " + variable["name"]);
    if (variable["causality"] == "independent") ++independent;
  }
  if (independent != 1) out.push_back(fmt::format("{} independent variables, there is one time", independent));
}

bool derives(const std::string& unit, const std::string& of) {
  return unit == of + "/s" || (of.ends_with("/s") && unit == of + "2");
}

void check_structure(const UnpackedFmu& fmu, Violations& out) {
  const bool fmi2 = fmu.version() == FmiVersion::fmi2;
  Violations wanted;
  for (std::size_t k = 0; k < fmu.variables().size(); ++k) {
    const XmlElement& variable = fmu.variables()[k];
    if (variable["causality"] == "output") wanted.push_back(fmi2 ? std::to_string(k + 1) : variable["valueReference"]);
  }
  Violations outputs, initial, derivatives, declared;
  for (std::size_t k = 0; k < fmu.variables().size(); ++k) {
    const XmlElement& variable = fmu.variables()[k];
    if (!variable.has("derivative")) continue;
    declared.push_back(fmi2 ? std::to_string(k + 1) : variable["valueReference"]);
    const std::size_t state = std::stoul(variable["derivative"]) - (fmi2 ? 1 : 0);
    const XmlElement& of = fmu.variables().at(state);
    if (!derives(variable["unit"], of["unit"]) || of["variability"] != "continuous" || state == k)
      out.push_back(variable["name"] + " is no derivative of " + of["name"]);
  }
  for (const XmlElement& element : fmu.description()) {
    const std::string where = element.path.substr(0, element.path.rfind('/'));
    if (fmi2 && where.ends_with("/Outputs")) outputs.push_back(element["index"]);
    if (fmi2 && where.ends_with("/InitialUnknowns")) initial.push_back(element["index"]);
    if (fmi2 && where.ends_with("/Derivatives")) derivatives.push_back(element["index"]);
    if (!fmi2 && element.name == "ContinuousStateDerivative") derivatives.push_back(element["valueReference"]);
    if (!fmi2 && element.name == "Output") outputs.push_back(element["valueReference"]);
    if (!fmi2 && element.name == "InitialUnknown") initial.push_back(element["valueReference"]);
  }
  if (derivatives != declared) out.push_back("ModelStructure does not list exactly the derivatives, in order");
  if (outputs != wanted) out.push_back("ModelStructure does not list exactly the outputs, in order");
  if (initial != wanted) out.push_back("the initial unknowns are not the calculated outputs, in order");
}

void check_files(const UnpackedFmu& fmu, Violations& out) {
  const bool fmi2 = fmu.version() == FmiVersion::fmi2;
  const std::string identifier = fmu.description().at(1)["modelIdentifier"];
  std::set<std::string> wanted{
      "documentation/index.html", "documentation/licenses/license.txt",
      fmi2 ? "binaries/linux64/" + identifier + ".so" : "binaries/x86_64-linux/" + identifier + ".so",
      fmi2 ? "binaries/win64/" + identifier + ".dll" : "binaries/x86_64-windows/" + identifier + ".dll",
      fmi2 ? "model.png" : "terminalsAndIcons/icon.png"};
  Violations described, built;
  for (const XmlElement& element : fmu.description()) {
    if (element.name == "File") described.push_back(element["name"]);
  }
  for (const XmlElement& element : xml_elements(fmu.content("sources/buildDescription.xml"))) {
    if (element.name == "SourceFile") built.push_back(element["name"]);
  }
  if (built.empty()) out.push_back("no sources are listed");
  if (fmi2 && described != built) out.push_back("modelDescription and buildDescription name other sources");
  for (const std::string& source : built) wanted.insert("sources/" + source);
  for (const std::string& name : wanted) {
    if (!std::filesystem::is_regular_file(fmu.folder() / name)) out.push_back("no file " + name);
  }
  if (fmu.content(fmi2 ? "model.png" : "terminalsAndIcons/icon.png").substr(1, 3) != "PNG") out.push_back("no icon");
}

}  // namespace

std::vector<std::string> description_violations(const UnpackedFmu& fmu) {
  Violations out;
  check_root(fmu, out);
  check_units(fmu, out);
  check_variables(fmu, out);
  check_structure(fmu, out);
  check_files(fmu, out);
  return out;
}

}  // namespace spoolflow::exports

#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/model/describe_campaign.hpp"
#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/model/json_tables.hpp"
#include "spoolflow/model/json_text.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/model/model_limits.hpp"

namespace spoolflow::model {
namespace {

Range range(const JsonNode& node) {
  const std::vector<double> ends = node.rising_numbers();
  if (ends.size() != 2) node.refuse(fmt::format("has {} entries, a range has 2", ends.size()));
  return {ends[0], ends[1]};
}

std::string tool_version(const JsonNode& node) {
  std::string out = node.text();
  const std::string tool = "spoolflow ";
  if (out.starts_with(tool)) out.erase(0, tool.size());
  return out;
}

std::string sha256(const JsonNode& node) {
  std::string out = node.text();
  if (out.size() != 64 || out.find_first_not_of("0123456789abcdef") != std::string::npos)
    node.refuse("no sha256 of 64 hexadecimal digits");
  return out;
}

std::string one_direction(const JsonNode& node) {
  std::string out = node.text();
  if (out != "a" && out != "b") node.refuse("is neither \"a\" nor \"b\"");
  return out;
}

Adaptation adaptation(const JsonNode& node) {
  Adaptation out{tool_version(node.at("tool")), node.at("created").text(), sha256(node.at("adapted_from")), {}, {}};
  for (const JsonNode& file : node.at("files").elements()) out.files.push_back(file.text());
  for (const JsonNode& each : node.at("corrections").elements()) {
    out.corrections.push_back({each.at("direction").text(), each.at("of").text(), each.at("unit").text(),
                               each.at("value").number(), each.at("uncertainty_95").number(0, 1e15)});
  }
  if (node.has("reasons")) {
    for (const JsonNode& reason : node.at("reasons").elements()) out.reasons.push_back(reason.text());
  }
  if (node.has("wear")) {
    const JsonNode wear = node.at("wear");
    out.wear = {wear.at("edge_width").number(-0.5, 1), wear.at("friction_ratio").number(0.1, 10),
                wear.at("position_zero_m").number(-1e-3, 1e-3), wear.at("flow_share").number(0, 1),
                wear.at("friction_share").number(0, 10)};
  }
  if (node.has("direction")) out.direction = one_direction(node.at("direction"));
  return out;
}

KnownQuantity known_quantity(const JsonNode& node) {
  KnownQuantity out{one_direction(node.at("direction")),
                    node.at("of").text(),
                    node.at("how").text(),
                    node.at("from").text(),
                    node.at("unit").text(),
                    {}};
  if (out.how != "measured" && out.how != "inferred" && out.how != "assumed")
    node.at("how").refuse("is neither \"measured\" nor \"inferred\" nor \"assumed\"");
  if (node.has("uncertainty_95")) out.uncertainty_95 = node.at("uncertainty_95").number(0, 1e15);
  return out;
}

Provenance provenance(const JsonNode& node) {
  Provenance out{tool_version(node.at("tool")), node.at("created").text(), {}};
  for (const JsonNode& input : node.at("inputs").elements()) {
    out.inputs.push_back({input.at("protocol").text(), input.at("file").text(), sha256(input.at("sha256")),
                          static_cast<std::uint64_t>(input.at("samples").number(0, 1e15))});
  }
  if (node.has("adaptations")) {
    for (const JsonNode& each : node.at("adaptations").elements()) out.adaptations.push_back(adaptation(each));
  }
  if (node.has("doubts")) {
    for (const JsonNode& each : node.at("doubts").elements()) out.doubts.push_back(each.text());
  }
  if (node.has("quantities")) {
    for (const JsonNode& each : node.at("quantities").elements()) out.quantities.push_back(known_quantity(each));
  }
  out.simulated = node.has("origin") && node.at("origin").text() == "simulated";
  return out;
}

std::vector<Residual> residuals(const JsonNode& node) {
  std::vector<Residual> out;
  for (const JsonNode& residual : node.elements()) {
    out.push_back({residual.at("of").text(), residual.at("unit").text(), residual.at("rms").number(0, 1e12),
                   residual.at("largest").number(0, 1e12)});
  }
  return out;
}

Fit fit(const JsonNode& node) {
  Fit out{node.at("of").text(), {}, {}};
  for (const JsonNode& each : node.at("parameters").elements()) {
    out.parameters.push_back(
        {each.at("name").text(), each.at("value").number(), each.at("uncertainty").number(0, 1e15)});
  }
  out.correlation = node.at("correlation").numbers();
  const std::size_t wanted = out.parameters.size() * out.parameters.size();
  if (out.correlation.size() != wanted) {
    node.at("correlation").refuse(fmt::format("has {} entries, {} would fit", out.correlation.size(), wanted));
  }
  return out;
}

Observer observer(const JsonNode& node) {
  Observer out{};
  out.oil_temperature_K = range(node.at("oil_temperature_range_K"));
  out.residuals = residuals(node.at("residuals"));
  if (node.has("fits")) {
    for (const JsonNode& each : node.at("fits").elements()) out.fits.push_back(fit(each));
  }
  for (const JsonNode& each : node.at("defaults").elements()) out.defaults.push_back(each.text());
  describe_observer(out.parameters, TableReader(node));
  return out;
}

TypeSection type_section(const JsonNode& node) {
  TypeSection out;
  out.name = node.at("name").text();
  const std::string of = node.at("of").text();
  if (of != "unit" && of != "type") node.at("of").refuse("is neither \"unit\" nor \"type\"");
  out.unit = of == "unit";
  for (const JsonNode& each : node.at("deviations").elements()) {
    out.deviations.push_back({each.at("name").text(), each.at("unit").text(), each.at("tolerance").number(1e-12, 10),
                              each.at("value").number(-10, 10), each.at("uncertainty").number(0, 10)});
  }
  out.correlation = node.at("correlation").numbers();
  const std::size_t wanted = out.deviations.size() * out.deviations.size();
  if (out.correlation.size() != wanted)
    node.at("correlation").refuse(fmt::format("has {} entries, {} would fit", out.correlation.size(), wanted));
  const JsonNode environment = node.at("environment_without_spread");
  out.environment = {environment.at("force_N").number(0, 1e5), environment.at("friction_share").number(0, 10),
                     environment.at("flow_share").number(0, 10),
                     environment.has("breakaway_share") ? environment.at("breakaway_share").number(0, 10) : 0};
  return out;
}

Condensed condensed(const JsonNode& node) {
  Condensed out{};
  out.current_A = range(node.at("current_range_A"));
  out.position_m = range(node.at("position_range_m"));
  out.pressure_difference_Pa = range(node.at("pressure_difference_range_Pa"));
  if (node.has("oil_temperature_K")) out.oil_temperature_K = node.at("oil_temperature_K").number(200, 500);
  out.residuals = residuals(node.at("residuals"));
  describe_condensed(out.parameters, TableReader(node));
  return out;
}

/// `count` numbers; a loop's columns are as long as its positions.
std::vector<double> column(const JsonNode& node, const char* key, std::size_t count) {
  std::vector<double> values = node.at(key).numbers();
  if (values.size() != count) {
    node.at(key).refuse(fmt::format("has {} entries, {} would fit", values.size(), count));
  }
  return values;
}

std::vector<MapResidual> map_residuals(const JsonNode& node) {
  std::vector<MapResidual> out;
  for (const JsonNode& each : node.elements()) {
    const std::vector<double> position_m = each.at("position_m").rising_numbers();
    out.push_back({each.at("held").number(), each.at("oil_temperature_K").number(), position_m,
                   column(each, "mean_N", position_m.size()), column(each, "rms_N", position_m.size())});
  }
  return out;
}

Evidence evidence(const JsonNode& node) {
  Evidence out;
  for (const JsonNode& loop : node.at("magnetic_force_loops").elements()) {
    const std::vector<double> position_m = loop.at("position_m").rising_numbers();
    out.magnetic_force.push_back({loop.at("current_A").number(), position_m,
                                  column(loop, "opening_N", position_m.size()),
                                  column(loop, "closing_N", position_m.size())});
  }
  for (const JsonNode& loop : node.at("axial_force_loops").elements()) {
    const std::vector<double> position_m = loop.at("position_m").rising_numbers();
    const std::size_t n = position_m.size();
    out.axial_force.push_back({loop.at("pressure_difference_set_Pa").number(), position_m, column(loop, "opening_N", n),
                               column(loop, "closing_N", n), column(loop, "flow_m3_per_s", n),
                               column(loop, "pressure_difference_Pa", n)});
  }
  if (node.has("solenoid_traces")) {
    for (const JsonNode& trace : node.at("solenoid_traces").elements()) {
      const std::vector<double> current_A = trace.at("current_A").numbers();
      const std::size_t n = current_A.size();
      out.bench.solenoid.push_back({static_cast<int>(trace.at("test").number(0, 1e6)), trace.at("position_m").number(),
                                    current_A, column(trace, "measured_N", n), column(trace, "model_N", n),
                                    column(trace, "map_N", n)});
    }
  }
  if (node.has("magnetic_force_residuals")) {
    out.bench.magnetic_force = map_residuals(node.at("magnetic_force_residuals"));
    out.bench.axial_force = map_residuals(node.at("axial_force_residuals"));
  }
  const JsonNode sensitivity = node.at("sensitivity");
  out.sensitivity.position_m = sensitivity.at("position_m").rising_numbers();
  out.sensitivity.pressure_difference_Pa = sensitivity.at("pressure_difference_Pa").rising_numbers();
  out.sensitivity.flow_per_force_m3_per_s_N =
      column(sensitivity, "flow_per_force_m3_per_s_N",
             out.sensitivity.position_m.size() * out.sensitivity.pressure_difference_Pa.size());
  const JsonNode uniqueness = node.at("uniqueness");
  out.uniqueness = {uniqueness.at("unique_from_m").number(), uniqueness.at("blind_below_m").number(),
                    uniqueness.at("ambiguous_at_m").numbers()};
  return out;
}

nlohmann::ordered_json parsed(const std::string& text, const std::string& file) {
  try {
    return nlohmann::ordered_json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    std::size_t line = 1;
    const std::size_t end = std::min<std::size_t>(error.byte, text.size());
    for (std::size_t k = 0; k < end; ++k) line += text[k] == '\n' ? 1 : 0;
    const bool cut = error.byte >= text.size();
    throw ModelError(fmt::format("{}, line {}: {}; make the model again with `spoolflow calibrate`", file, line,
                                 cut ? "the file ends in the middle of the JSON text, it was cut short"
                                     : "this is not valid JSON (NaN and infinity are not numbers there)"));
  } catch (const nlohmann::json::out_of_range&) {
    throw ModelError(fmt::format("{}: a number is too large for double precision", file));
  }
}

}  // namespace

Model parse_model(const std::string& text, const std::string& file) {
  require_json_limits(text, file);
  const nlohmann::ordered_json json = parsed(text, file);
  const JsonNode root(json, "", file);
  if (!root.has("format") || !json["format"].is_string() || json["format"] != "spoolflow model") {
    root.refuse(
        "this is no spoolflow model (no \"format\": \"spoolflow model\"); give a file that `spoolflow calibrate` "
        "wrote");
  }
  const double version = root.at("version").number();
  if (version != model_version) {
    root.at("version").refuse(fmt::format(
        "version {} is not version {}, which this program reads; calibrate again with it", version, model_version));
  }
  Model out;
  const JsonNode valve = root.at("valve");
  out.valve.name = valve.at("name").text();
  out.valve.direction = valve.at("direction").text();
  describe_valve(out.valve, TableReader(valve));
  if (out.valve.direction != "a" && out.valve.direction != "b" && out.valve.direction != "both")
    valve.at("direction").refuse("is neither \"a\" nor \"b\" nor \"both\"");
  const JsonNode fluid = root.at("fluid");
  out.fluid.name = fluid.at("name").text();
  describe_fluid(out.fluid, TableReader(fluid));
  if (root.has("instruments")) describe_instruments(out.instruments, TableReader(root.at("instruments")));
  out.provenance = provenance(root.at("provenance"));
  out.condensed = condensed(root.at("condensed"));
  if (root.has("observer")) out.observer = observer(root.at("observer"));
  if (root.has("type")) out.type = type_section(root.at("type"));
  out.evidence = evidence(root.at("evidence"));
  if (out.valve.direction == "both") {
    const JsonNode p_to_a = root.at("p_to_a");
    out.p_to_a = Direction{condensed(p_to_a.at("condensed")), std::nullopt, evidence(p_to_a.at("evidence"))};
    if (p_to_a.has("observer")) out.p_to_a->observer = observer(p_to_a.at("observer"));
    if (p_to_a.has("type")) out.p_to_a->type = type_section(p_to_a.at("type"));
  }
  require_limits(out, file);
  return out;
}

Model read_model(const std::filesystem::path& file) {
  std::error_code unreadable;
  if (std::filesystem::is_directory(file, unreadable))
    throw ModelError(fmt::format("{}: is a folder, not a model file", file.string()));
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    throw ModelError(
        fmt::format("{}: cannot be opened; check the path, or make a model with `spoolflow calibrate`", file.string()));
  }
  const std::string text = read_json_text(in);
  if (text.empty())
    throw ModelError(
        fmt::format("{}: the file is empty; make the model again with `spoolflow calibrate`", file.string()));
  return parse_model(text, file.string());
}

}  // namespace spoolflow::model

/// The model file: what it holds, each entry described once, read and written.
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/model/describe_campaign.hpp"
#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/model/file_section.hpp"
#include "spoolflow/model/json_text.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/model/model_limits.hpp"

namespace spoolflow::model {
namespace {

void input(InputFile& input, FileSection& file) {
  file.text("protocol", input.protocol);
  file.text("file", input.file);
  file.sha256("sha256", input.sha256);
  file.number("samples", input.samples, {0, 1e15});
}

void correction(Correction& correction, FileSection& file) {
  file.text("direction", correction.direction);
  file.text("of", correction.of);
  file.text("unit", correction.unit);
  file.number("value", correction.value);
  file.number("uncertainty_95", correction.uncertainty_95, {0, 1e15});
}

void wear(WearState& wear, FileSection& file) {
  file.number("edge_width", wear.edge_width, {-0.5, 1});
  file.number("friction_ratio", wear.friction_ratio, {0.1, 10});
  file.number("position_zero_m", wear.position_zero_m, {-1e-3, 1e-3});
  file.number("flow_share", wear.flow_share, {0, 1});
  file.number("friction_share", wear.friction_share, {0, 10});
}

void adaptation(Adaptation& adaptation, FileSection& file) {
  file.tool("tool", adaptation.tool_version);
  file.text("created", adaptation.created);
  file.sha256("adapted_from", adaptation.adapted_from);
  file.texts("files", adaptation.files);
  file.list("corrections", adaptation.corrections, correction);
  file.texts("reasons", adaptation.reasons, Held::where_any);
  file.section("wear", adaptation.wear, wear);
  if (file.holds("direction", adaptation.direction.empty(), Held::where_any))
    file.one_of("direction", adaptation.direction, {"a", "b"});
}

void quantity(KnownQuantity& quantity, FileSection& file) {
  file.one_of("direction", quantity.direction, {"a", "b"});
  file.text("of", quantity.of);
  file.one_of("how", quantity.how, {"measured", "inferred", "assumed"});
  file.text("from", quantity.from);
  file.text("unit", quantity.unit);
  file.number("uncertainty_95", quantity.uncertainty_95, {0, 1e15});
}

void provenance(Provenance& provenance, FileSection& file) {
  file.tool("tool", provenance.tool_version);
  file.text("created", provenance.created);
  file.list("inputs", provenance.inputs, input);
  file.list("adaptations", provenance.adaptations, adaptation, Held::where_any);
  file.texts("doubts", provenance.doubts, Held::where_any);
  file.list("quantities", provenance.quantities, quantity, Held::where_any);
  file.mark("origin", provenance.simulated, "simulated");
}

void residual(Residual& residual, FileSection& file) {
  file.text("of", residual.of);
  file.text("unit", residual.unit);
  file.number("rms", residual.rms, {0, 1e12});
  file.number("largest", residual.largest, {0, 1e12});
}

void parameter(FittedParameter& parameter, FileSection& file) {
  file.text("name", parameter.name);
  file.number("value", parameter.value);
  file.number("uncertainty", parameter.uncertainty, {0, 1e15});
}

void fit(Fit& fit, FileSection& file) {
  file.text("of", fit.of);
  file.list("parameters", fit.parameters, parameter);
  file.numbers("correlation", fit.correlation, fit.parameters.size() * fit.parameters.size());
}

void condensed(Condensed& condensed, FileSection& file) {
  file.range("current_range_A", condensed.current_A.lower, condensed.current_A.upper);
  file.range("position_range_m", condensed.position_m.lower, condensed.position_m.upper);
  file.range("pressure_difference_range_Pa", condensed.pressure_difference_Pa.lower,
             condensed.pressure_difference_Pa.upper);
  file.number("oil_temperature_K", condensed.oil_temperature_K, {200, 500});
  file.list("residuals", condensed.residuals, residual);
  describe_condensed(condensed.parameters, file);
}

void observer(Observer& observer, FileSection& file) {
  file.range("oil_temperature_range_K", observer.oil_temperature_K.lower, observer.oil_temperature_K.upper);
  file.list("residuals", observer.residuals, residual);
  file.list("fits", observer.fits, fit, Held::lately);
  file.texts("defaults", observer.defaults);
  describe_observer(observer.parameters, file);
}

void deviation(UnitDeviation& deviation, FileSection& file) {
  file.text("name", deviation.name);
  file.text("unit", deviation.unit);
  file.number("tolerance", deviation.tolerance, {1e-12, 10});
  file.number("value", deviation.value, {-10, 10});
  file.number("uncertainty", deviation.uncertainty, {0, 10});
}

void environment(EnvironmentWithoutSpread& environment, FileSection& file) {
  file.number("force_N", environment.force_N, {0, 1e5});
  file.number("friction_share", environment.friction_share, {0, 10});
  file.number("flow_share", environment.flow_share, {0, 10});
  file.number("breakaway_share", environment.breakaway_share, {0, 10}, Held::lately);
}

void type(TypeSection& type, FileSection& file) {
  file.text("name", type.name);
  file.either("of", type.unit, "unit", "type");
  file.list("deviations", type.deviations, deviation);
  file.numbers("correlation", type.correlation, type.deviations.size() * type.deviations.size());
  file.section("environment_without_spread", type.environment, environment);
}

void magnetic_force(MagneticForceLoop& loop, FileSection& file) {
  file.number("current_A", loop.current_A);
  file.rising_numbers("position_m", loop.position_m);
  file.numbers("opening_N", loop.opening_N, loop.position_m.size());
  file.numbers("closing_N", loop.closing_N, loop.position_m.size());
}

void axial_force(AxialForceLoop& loop, FileSection& file) {
  file.number("pressure_difference_set_Pa", loop.pressure_difference_set_Pa);
  file.rising_numbers("position_m", loop.position_m);
  const std::size_t positions = loop.position_m.size();
  file.numbers("opening_N", loop.opening_N, positions);
  file.numbers("closing_N", loop.closing_N, positions);
  file.numbers("flow_m3_per_s", loop.flow_m3_per_s, positions);
  file.numbers("pressure_difference_Pa", loop.pressure_difference_Pa, positions);
}

void trace(SolenoidTrace& trace, FileSection& file) {
  file.number("test", trace.test, {0, 1e6});
  file.number("position_m", trace.position_m);
  file.numbers("current_A", trace.current_A);
  const std::size_t samples = trace.current_A.size();
  file.numbers("measured_N", trace.measured_N, samples);
  file.numbers("model_N", trace.model_N, samples);
  file.numbers("map_N", trace.map_N, samples);
}

void map_residual(MapResidual& residual, FileSection& file) {
  file.number("held", residual.held);
  file.number("oil_temperature_K", residual.oil_temperature_K);
  file.rising_numbers("position_m", residual.position_m);
  file.numbers("mean_N", residual.mean_N, residual.position_m.size());
  file.numbers("rms_N", residual.rms_N, residual.position_m.size());
}

void sensitivity(SensitivityMap& map, FileSection& file) {
  file.rising_numbers("position_m", map.position_m);
  file.rising_numbers("pressure_difference_Pa", map.pressure_difference_Pa);
  file.numbers("flow_per_force_m3_per_s_N", map.flow_per_force_m3_per_s_N,
               map.position_m.size() * map.pressure_difference_Pa.size());
}

void uniqueness(Uniqueness& uniqueness, FileSection& file) {
  file.number("unique_from_m", uniqueness.unique_from_m);
  file.number("blind_below_m", uniqueness.blind_below_m);
  file.numbers("ambiguous_at_m", uniqueness.ambiguous_at_m);
}

void evidence(Evidence& evidence, FileSection& file) {
  file.list("magnetic_force_loops", evidence.magnetic_force, magnetic_force);
  file.list("axial_force_loops", evidence.axial_force, axial_force);
  file.list("solenoid_traces", evidence.bench.solenoid, trace, Held::lately);
  file.list("magnetic_force_residuals", evidence.bench.magnetic_force, map_residual, Held::lately);
  file.list("axial_force_residuals", evidence.bench.axial_force, map_residual, Held::lately);
  file.section("sensitivity", evidence.sensitivity, sensitivity);
  file.section("uniqueness", evidence.uniqueness, uniqueness);
}

/// One direction of a whole valve; of a Model that which stands at its top.
template <class Directed>
void direction(Directed& directed, FileSection& file) {
  file.section("condensed", directed.condensed, condensed);
  file.section("observer", directed.observer, observer);
  file.section("type", directed.type, type);
  file.section("evidence", directed.evidence, evidence);
}

void valve(Valve& valve, FileSection& file) {
  file.text("name", valve.name);
  describe_valve(valve, file);
  file.one_of("direction", valve.direction, {"a", "b", "both"});
}

void fluid(Fluid& fluid, FileSection& file) {
  file.text("name", fluid.name);
  describe_fluid(fluid, file);
}

void instruments(Instruments& instruments, FileSection& file) {
  describe_instruments(instruments, file);
}

/// All but format and version.
void describe(Model& model, FileSection& file) {
  file.section("valve", model.valve, valve);
  file.section("fluid", model.fluid, fluid);
  if (file.holds("instruments", model.instruments == Instruments{}, Held::where_any))
    file.section("instruments", model.instruments, instruments);
  file.section("provenance", model.provenance, provenance);
  direction(model, file);
  if (model.valve.direction != "both") return;
  if (!model.p_to_a) model.p_to_a.emplace();
  file.section("p_to_a", *model.p_to_a, direction<Direction>);
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
  FileSection in(root);
  describe(out, in);
  require_limits(out, file);
  return out;
}

void write_model(std::ostream& out, const Model& model) {
  require_limits(model, "the model to be written");
  nlohmann::ordered_json json{{"format", "spoolflow model"}, {"version", model_version}};
  FileSection file(json);
  Model described = model;
  describe(described, file);
  out << json.dump(1) << '\n';
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

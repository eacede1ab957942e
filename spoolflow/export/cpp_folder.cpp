#include "spoolflow/export/cpp_folder.hpp"

#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "spoolflow/export/cpp_texts.hpp"
#include "spoolflow/export/golden_points.hpp"
#include "spoolflow/export/number_groups.hpp"
#include "spoolflow/export/sensor_headers.hpp"
#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/model/limit_check.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::exports {
namespace {

std::string text(std::string_view name) {
  for (const EmbeddedFile& file : cpp_texts()) {
    if (file.name == name) return std::string(file.bytes);
  }
  throw std::logic_error(fmt::format("no text {} in the program", name));
}

/// As it may stand in a comment: nothing in it ends or continues a line.
std::string in_a_comment(const std::string& name) {
  std::string out;
  for (const char letter : name) out += static_cast<unsigned char>(letter) < ' ' || letter == '\\' ? ' ' : letter;
  return out;
}

/// As it may stand between quotes.
std::string in_quotes(const std::string& name) {
  std::string out;
  for (const char letter : in_a_comment(name)) {
    if (letter == '"' || letter == '?') out += '\\';
    out += letter;
  }
  return out;
}

std::string made_from(const model::Model& model) {
  return fmt::format("{} from the model of {}, direction {}, calibrated by spoolflow {} on {}.", cpp_model_mark,
                     in_a_comment(model.valve.name), in_a_comment(model.valve.direction),
                     in_a_comment(model.provenance.tool_version), in_a_comment(model.provenance.created));
}

std::string definition(const std::string& type, const std::string& name, const std::vector<double>& numbers,
                       const std::vector<NumberGroup>& groups) {
  return fmt::format(
      "inline constexpr auto {1} = std::bit_cast<spoolflow::sensor::{0}<float>>(std::array<float, {2}>{{\n{3}}});\n\n",
      type, name, numbers.size(), literals(numbers, groups));
}

std::string condensed_definition(const model::Model& model) {
  const auto tables = std::make_unique<sensor::CondensedTables<double>>();
  sensor::lay_out(model.condensed.parameters, *tables);
  const std::vector<double> numbers = numbers_of(*tables);
  NumberGroups groups(tables.get());
  model::describe_condensed_tables(*tables, groups);
  return definition("CondensedTables", "condensed", numbers, groups.in_order(numbers.size()));
}

/// What holds in double precision need not hold in the valve's: two thresholds may have become one.
void require_limits_in_single_precision(const model::Observer& observer) {
  const auto found = model::violation(single_precision(observer.parameters), [](auto& parameters, auto& visitor) {
    model::describe_observer(parameters, visitor);
  });
  if (found) {
    throw std::invalid_argument(
        fmt::format("in single precision the model's /observer{}: {}; calibrate again and look at the report for what "
                    "went astray",
                    found->path, found->problem));
  }
}

std::string observer_definition(const model::Observer& observer) {
  require_limits_in_single_precision(observer);
  const std::vector<double> numbers = numbers_of(observer.parameters);
  NumberGroups groups(&observer.parameters);
  model::describe_observer(observer.parameters, groups);
  return definition("ObserverParameters", "observer", numbers, groups.in_order(numbers.size()));
}

std::string model_header(const model::Model& model) {
  const bool whole = model.observer.has_value();
  std::string out = made_from(model) + "\n#pragma once\n#include <array>\n#include <bit>\n\n";
  out += "#include \"spoolflow/sensor/condensed.hpp\"\n";
  if (whole) out += "#include \"spoolflow/sensor/observer.hpp\"\n";
  out +=
      "\n/// One valve's numbers, SI. The arrays lie in flash as the sensor's structures do.\nnamespace valve_model "
      "{\n\n";
  out += fmt::format("inline constexpr char name[] = \"{}\";\n", in_quotes(model.valve.name));
  out += fmt::format("inline constexpr float rated_flow_m3_per_s = {};  // {:.4g} L/min\n",
                     float_literal(model.valve.rated_flow_m3_per_s),
                     units::L_per_min_from_m3_per_s(model.valve.rated_flow_m3_per_s));
  out += fmt::format("inline constexpr float stroke_m = {};\n", float_literal(model.valve.stroke_m));
  out += fmt::format("inline constexpr bool has_observer = {};\n\n", whole);
  out += condensed_definition(model);
  if (whole) out += observer_definition(*model.observer);
  out += fmt::format(
      "/// The best sensor that this model is calibrated for.\n"
      "inline constexpr const auto& parameters = {};\n"
      "using State = spoolflow::sensor::{}State<float>;\n\n}}  // namespace valve_model\n",
      whole ? "observer" : "condensed", whole ? "Observer" : "Condensed");
  return out;
}

std::string sample_literal(float number) {
  return number == number ? float_literal(static_cast<double>(number)) : "missing";
}

std::string golden_header(const model::Model& model, const std::vector<GoldenPoint>& points) {
  std::string out = made_from(model) + "\n#pragma once\n#include <array>\n#include <limits>\n\n";
  out +=
      "#include \"spoolflow/sensor/sample.hpp\"\n\nnamespace valve_model {\n\n"
      "/// One sample and the flow rates [m3/s] that double precision answered on the host.\n"
      "struct GoldenPoint {\n"
      "  spoolflow::sensor::Sample<float> sample;\n"
      "  float condensed_m3_per_s;\n"
      "  float best_m3_per_s;  ///< of `parameters`\n"
      "};\n\n"
      "inline constexpr float missing = std::numeric_limits<float>::quiet_NaN();\n\n";
  out += fmt::format(
      "/// In the order of time: time step s, current A, voltage V, position m, oil temperature K; flow rates.\n"
      "inline constexpr std::array<GoldenPoint, {}> golden_points{{{{\n",
      points.size());
  for (const GoldenPoint& point : points) {
    const sensor::Sample<float>& in = point.sample;
    out += fmt::format("    {{{{{}, {}, {}, {}, {}}}, {}, {}}},\n", sample_literal(in.time_step_s),
                       sample_literal(in.current_A), sample_literal(in.voltage_V), sample_literal(in.position_m),
                       sample_literal(in.oil_temperature_K), float_literal(point.condensed_m3_per_s),
                       float_literal(point.best_m3_per_s));
  }
  return out + "}};\n\n}  // namespace valve_model\n";
}

std::string readme(const model::Model& model, const std::vector<GoldenPoint>& points) {
  const SinglePrecisionError error = single_precision_error(model, points);
  std::string sensors = fmt::format("the condensed sensor ({:.2g} %)", error.condensed_percent);
  if (model.observer) {
    sensors = fmt::format("the observer ({:.2g} %) and ", error.best_percent) + sensors;
  } else {
    sensors += ". **The model is not calibrated for the observer**, so it is not here";
  }
  std::string out = text("README.md.in");
  const auto put = [&out](const std::string& place, const std::string& content) {
    out.replace(out.find(place), place.size(), content);
  };
  put("@VALVE@", model.valve.name);
  put("@SENSORS@", sensors);
  return out;
}

}  // namespace

std::vector<ExportedFile> cpp_folder(const model::Model& model) {
  const std::vector<GoldenPoint> points = golden_points(model);
  std::vector<ExportedFile> files{{"README.md", readme(model, points)},
                                  {"example.cpp", text("example.cpp.in")},
                                  {"self_test.cpp", text("self_test.cpp.in")},
                                  {"golden_points.hpp", golden_header(model, points)},
                                  {std::string(cpp_model_name), model_header(model)}};
  for (const EmbeddedFile& header : sensor_headers()) {
    files.push_back({fmt::format("spoolflow/sensor/{}", header.name), std::string(header.bytes)});
  }
  return files;
}

}  // namespace spoolflow::exports

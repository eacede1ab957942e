#include "spoolflow/export/cpp_folder.hpp"

#include <cctype>
#include <cstdint>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "spoolflow/export/cpp/c_header.hpp"
#include "spoolflow/export/cpp/cell_sums.hpp"
#include "spoolflow/export/cpp/exported_text.hpp"
#include "spoolflow/export/embedded_files.hpp"
#include "spoolflow/export/golden_points.hpp"
#include "spoolflow/export/number_groups.hpp"
#include "spoolflow/export/parameters/parameter_image.hpp"
#include "spoolflow/model/describe_condensed.hpp"
#include "spoolflow/model/describe_observer.hpp"
#include "spoolflow/numerics/crc32.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::exports {
namespace {

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

/// As it may stand in a name of C++.
std::string in_an_identifier(const std::string& name) {
  std::string out;
  for (const char letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0) out += letter;
  return out;
}

std::string made_from(const model::Model& model) {
  return fmt::format("{} from the model of {}, direction {}, calibrated by spoolflow {} on {}.", cpp_model_mark,
                     in_a_comment(model.valve.name), in_a_comment(model.valve.direction),
                     in_a_comment(model.provenance.tool_version), in_a_comment(model.provenance.created));
}

std::string definition(const std::string& type, const std::string& name, const std::vector<double>& numbers,
                       const std::vector<NumberGroup>& groups) {
  std::vector<float> single;
  for (const double number : numbers) single.push_back(single_precision(number));
  return fmt::format(
      "inline SPOOLFLOW_TABLE auto {1} = spoolflow::sensor::bits_as<spoolflow::sensor::{0}<float>>(std::array<float, "
      "{2}>{{\n{3}}});\n"
      "inline constexpr std::uint32_t {1}_crc32 = 0x{4:08X}U;\n\n",
      type, name, numbers.size(), literals(numbers, groups),
      numerics::crc32({reinterpret_cast<const std::uint8_t*>(single.data()), single.size() * sizeof(float)}));
}

/// Names of all definitions in the model's header.
std::vector<std::string> definition_names(const model::Model& model) {
  std::vector<std::string> names;
  const std::vector<std::string> sides =
      model.whole() ? std::vector<std::string>{"_b", "_a"} : std::vector<std::string>{""};
  for (const std::string& side : sides) {
    names.push_back("condensed" + side);
    if (model.has_observer()) names.push_back("observer" + side);
  }
  return names;
}

/// Functions with which firmware proves its flash: for each sensor those of its own tables, since a table that is
/// looked at is kept by the linker.
std::string table_check(const model::Model& model) {
  std::string out = exported_text("table_check.hpp.in");
  const auto add = [&](const std::string& sensor, const std::string& function) {
    std::string all;
    for (const std::string& name : definition_names(model)) {
      if (!name.starts_with(sensor)) continue;
      if (!all.empty()) all += " && ";
      all += fmt::format("crc32_of({0}) == {0}_crc32", name);
    }
    out += fmt::format("inline bool {}() {{\n  return {};\n}}\n", function, all);
  };
  add("condensed", "condensed_intact");
  out += "/// The same of `parameters`.\n";
  add(model.has_observer() ? "observer" : "condensed", "tables_intact");
  return out + "\n";
}

/// Of the sensor's headers as a whole: another in each version that changed one of them.
const std::string& headers_mark() {
  static const std::string mark = [] {
    std::string all;
    for (const EmbeddedFile& header : sensor_headers()) all += header.bytes;
    return model::sha256_of_text(all).substr(0, 8);
  }();
  return mark;
}

/// A header of the sensor in a namespace of its version's own: where exports of two versions meet in one program, the
/// linker must not take the functions of one for the other's.
std::string marked_header(std::string header) {
  const auto replace = [&header](std::string_view text, const std::string& by) {
    const std::size_t at = header.find(text);
    if (at != std::string::npos) header.replace(at, text.size(), by);
  };
  replace("namespace spoolflow::sensor {\n",
          fmt::format("namespace spoolflow::sensor {{ inline namespace of_{} {{\n", headers_mark()));
  replace("}  // namespace spoolflow::sensor\n", "}}  // namespace spoolflow::sensor\n");
  return header;
}

/// `valve_model`, and in it a namespace of this model's and version's own: where two exports meet in one program, the
/// linker must not take the tables of one for the other's.
std::string namespace_begin(const model::Model& model) {
  const std::string direction = model.whole() ? "" : "_" + in_an_identifier(model.valve.direction);
  return fmt::format("namespace valve_model {{\ninline namespace of_{}{}_{} {{\n\n",
                     sha256_of_model(model).substr(0, 8), direction, headers_mark());
}
constexpr std::string_view namespace_end = "}\n}  // namespace valve_model\n";

/// `name`: of the definition.
std::string condensed_definition(const model::Condensed& condensed, const std::string& name) {
  const auto tables = std::make_unique<sensor::CondensedTables<double>>();
  sensor::lay_out(condensed.parameters, *tables);
  const std::vector<double> numbers = numbers_of(*tables);
  NumberGroups groups(tables.get());
  model::describe_condensed_tables(*tables, groups);
  return definition("CondensedTables", name, numbers, groups.in_order(numbers.size()));
}

std::string observer_definition(const model::Observer& observer, const std::string& name, const std::string& path) {
  (void)single_tables(observer, path);  // it holds there, too
  const std::vector<double> numbers = numbers_of(observer.parameters);
  NumberGroups groups(&observer.parameters);
  model::describe_observer(observer.parameters, groups);
  return definition("ObserverParameters", name, numbers, groups.in_order(numbers.size()));
}

std::string direction_definitions(const model::Model& model) {
  std::string out = condensed_definition(model.condensed, "condensed");
  if (model.has_observer()) out += observer_definition(*model.observer, "observer", "/observer");
  return out;
}

std::string whole_definitions(const model::Model& model) {
  const model::Direction& a = model.p_to_a.value();
  std::string out =
      condensed_definition(model.condensed, "condensed_b") + condensed_definition(a.condensed, "condensed_a");
  out +=
      "/// Of both directions: flow P to B, flow P to A.\n"
      "inline constexpr spoolflow::sensor::WholeCondensedTables<float> condensed{&condensed_b, &condensed_a};\n\n";
  if (!model.has_observer()) return out;
  out += observer_definition(*model.observer, "observer_b", "/observer") +
         observer_definition(*a.observer, "observer_a", "/p_to_a/observer");
  return out +
         "/// Of both directions: flow P to B, flow P to A.\n"
         "inline constexpr spoolflow::sensor::WholeValveParameters<float> observer{&observer_b, &observer_a};\n\n";
}

/// The sensor's types for a model of one direction or of a whole valve, as the headers name them.
struct TypeNames {
  const char* sample;
  const char* condensed;  ///< state
  const char* observer;   ///< state
};
TypeNames type_names(const model::Model& model) {
  if (model.whole()) return {"WholeValveSample", "WholeCondensedState", "WholeValveState"};
  return {"Sample", "CondensedState", "ObserverState"};
}

std::string sensor_includes(const model::Model& model) {
  const std::string check = "#include \"spoolflow/sensor/parameter_image/image_check.hpp\"\n";  // its CRC-32
  if (model.whole()) {
    return check +
           "#include \"spoolflow/sensor/whole_valve/whole_condensed.hpp\"\n"
           "#include \"spoolflow/sensor/whole_valve/whole_valve.hpp\"\n";
  }
  return std::string("#include \"spoolflow/sensor/condensed.hpp\"\n") +
         (model.has_observer() ? "#include \"spoolflow/sensor/observer.hpp\"\n" : "") + check;
}

std::string model_header(const model::Model& model) {
  const bool has_observer = model.has_observer();
  std::string out = made_from(model) + "\n#pragma once\n#include <array>\n#include <cstddef>\n#include <cstdint>\n\n" +
                    sensor_includes(model);
  out +=
      "\n/// One valve's numbers, SI. The arrays lie in flash as the sensor's structures do. The namespace within is "
      "the model's\n/// own, so that several exports may meet in one program.\n" +
      namespace_begin(model);
  out += fmt::format("inline constexpr char name[] = \"{}\";\n", in_quotes(model.valve.name));
  out += fmt::format("inline constexpr char model_sha256[] = \"{}\";  // of the model file as spoolflow writes it\n",
                     sha256_of_model(model));
  out += fmt::format("inline constexpr float rated_flow_m3_per_s = {};  // {:.4g} L/min\n",
                     float_literal(model.valve.rated_flow_m3_per_s),
                     units::L_per_min_from_m3_per_s(model.valve.rated_flow_m3_per_s));
  out += fmt::format("inline constexpr float stroke_m = {};\n", float_literal(model.valve.stroke_m));
  out += fmt::format("inline constexpr bool whole_valve = {};\n", model.whole());
  out += fmt::format("inline constexpr bool has_observer = {};\n\n", has_observer);
  out += model.whole() ? whole_definitions(model) : direction_definitions(model);
  out += table_check(model);
  const TypeNames types = type_names(model);
  return out + fmt::format(
                   "/// The best sensor that this model is calibrated for.\n"
                   "inline constexpr const auto& parameters = {};\n"
                   "using State = spoolflow::sensor::{}<float>;\n"
                   "using CondensedState = spoolflow::sensor::{}<float>;\n"
                   "using Sample = spoolflow::sensor::{}<float>;\n\n{}",
                   has_observer ? "observer" : "condensed", has_observer ? types.observer : types.condensed,
                   types.condensed, types.sample, namespace_end);
}

std::string sample_literal(float number) {
  return number == number ? float_literal(static_cast<double>(number)) : "missing";
}

std::string literals_of(const sensor::Sample<float>& in) {
  return fmt::format("{}, {}, {}, {}, {}", sample_literal(in.time_step_s), sample_literal(in.current_A),
                     sample_literal(in.voltage_V), sample_literal(in.position_m), sample_literal(in.oil_temperature_K));
}
std::string literals_of(const sensor::WholeValveSample<float>& in) {
  return fmt::format("{}, {}, {}, {}, {}, {}, {}", sample_literal(in.time_step_s), sample_literal(in.current_a_A),
                     sample_literal(in.current_b_A), sample_literal(in.voltage_a_V), sample_literal(in.voltage_b_V),
                     sample_literal(in.position_m), sample_literal(in.oil_temperature_K));
}

/// What one definition's tables answer, in double precision.
template <class Tables>
std::string cell_sums(const std::string& name, const Tables& tables) {
  std::string sums;
  std::size_t count = 0;
  sensor::CondensedState<double> state{};
  sum_cells(tables, state, [&](const CellSum<double>& row) {
    sums += fmt::format("{}{},", count % 10 == 0 ? "\n    " : " ", float_literal(row.sum));
    ++count;
  });
  return fmt::format("inline constexpr std::array<float, {}> {}_cells{{{{{}\n}}}};\n\n", count, name, sums);
}

/// The sums of every table, and the functions that compare them.
std::string cell_proof(const model::Model& model) {
  std::string out = "/// What the tables answer in the middle of their cells, summed up along each row.\n";
  const auto add = [&out](const std::string& side, const model::Condensed& condensed,
                          const std::optional<model::Observer>& observer) {
    const auto tables = std::make_unique<sensor::CondensedTables<double>>();
    sensor::lay_out(condensed.parameters, *tables);
    out += cell_sums("condensed" + side, *tables);
    if (observer) out += cell_sums("observer" + side, observer->parameters);
  };
  add(model.whole() ? "_b" : "", model.condensed, model.has_observer() ? model.observer : std::nullopt);
  if (model.whole()) add("_a", model.p_to_a->condensed, model.has_observer() ? model.p_to_a->observer : std::nullopt);
  for (const std::string sensor : {"condensed", "observer"}) {
    std::string all;
    for (const std::string& name : definition_names(model)) {
      if (name.starts_with(sensor))
        all += fmt::format("{}spoolflow::exports::cells_agree({}, {}_cells)", all.empty() ? "" : " && ", name, name);
    }
    out += fmt::format("inline bool {}_cells_agree() {{\n  return {};\n}}\n\n", sensor, all.empty() ? "true" : all);
  }
  return out;
}

template <class Sample>
std::string golden_header(const model::Model& model, const std::vector<GoldenPoint<Sample>>& points) {
  std::string out = made_from(model) + "\n#pragma once\n#include <array>\n#include <cstdint>\n#include <limits>\n\n";
  out += fmt::format(
      "#include \"cell_sums.hpp\"\n#include \"spoolflow/sensor/{}\"\n#include \"valve_model.hpp\"\n\n"
      "{}"
      "/// One sample and what double precision answered on the host.\n"
      "struct GoldenPoint {{\n"
      "  spoolflow::sensor::{}<float> sample;\n"
      "  float condensed_m3_per_s;\n"
      "  float best_m3_per_s;  ///< of `parameters`\n"
      "  float best_lower_m3_per_s;\n"
      "  float best_upper_m3_per_s;\n"
      "  std::uint32_t best_status;\n"
      "}};\n\n"
      "inline constexpr float missing = std::numeric_limits<float>::quiet_NaN();\n\n",
      model.whole() ? "whole_valve/whole_valve_sample.hpp" : "basis/sample.hpp", namespace_begin(model),
      type_names(model).sample);
  out += fmt::format(
      "/// In the order of time: time step s, {}, position m, oil temperature K; flow rates, band, status.\n"
      "inline constexpr std::array<GoldenPoint, {}> golden_points{{{{\n",
      model.whole() ? "currents a and b A, voltages a and b V" : "current A, voltage V", points.size());
  for (const GoldenPoint<Sample>& point : points) {
    out += fmt::format("    {{{{{}}}, {}, {}, {}, {}, {:#x}U}},\n", literals_of(point.sample),
                       float_literal(point.condensed_m3_per_s), float_literal(point.best_m3_per_s),
                       float_literal(point.best_lower_m3_per_s), float_literal(point.best_upper_m3_per_s),
                       static_cast<std::uint32_t>(point.best_status));
  }
  return out + "}};\n\n" + cell_proof(model) + std::string(namespace_end);
}

std::string readme(const model::Model& model, const SinglePrecisionError& error) {
  std::string sensors = fmt::format("the condensed sensor ({:.2g} %)", error.condensed_percent);
  if (model.has_observer()) {
    sensors = fmt::format("the observer ({:.2g} %) and ", error.best_percent) + sensors;
  } else {
    sensors += ". **The model is not calibrated for the observer**, so it is not here";
  }
  return exported_text("README.md.in", {{"@VALVE@", model.valve.name},
                                        {"@SENSORS@", sensors},
                                        {"@SIGNS@", model.whole() ? exported_text("whole_signs.md.in") : ""}});
}

/// What depends on the form of the samples: the points of the self-test, and how far single precision strays there.
template <class Sample>
std::vector<ExportedFile> proof(const model::Model& model, const std::vector<GoldenPoint<Sample>>& points) {
  return {{"README.md", readme(model, single_precision_error(model, points))},
          {"golden_points.hpp", golden_header(model, points)}};
}

}  // namespace

std::vector<ExportedFile> cpp_folder(const model::Model& model) {
  std::vector<ExportedFile> files =
      model.whole() ? proof(model, whole_golden_points(model)) : proof(model, golden_points(model));
  files.push_back({"example.cpp", exported_text(model.whole() ? "whole_example.cpp.in" : "example.cpp.in")});
  files.push_back({"valve_sensor.h", c_header(model)});
  files.push_back({"valve_sensor.cpp", exported_text("valve_sensor.cpp.in")});
  files.push_back({"example.c", exported_text("example.c.in")});
  files.push_back({"self_test.cpp", exported_text("self_test.cpp.in")});
  files.push_back({"cell_sums.hpp", exported_text("cell_sums.hpp")});
  files.push_back({std::string(cpp_model_name), model_header(model)});
  for (const EmbeddedFile& header : sensor_headers()) {
    files.push_back({fmt::format("spoolflow/sensor/{}", header.name), marked_header(std::string(header.bytes))});
  }
  files.push_back(record_of(files));
  return files;
}

ExportedFile record_of(const std::vector<ExportedFile>& files) {
  std::string record;
  for (const ExportedFile& file : files)
    record += fmt::format("{}  {}\n", model::sha256_of_text(file.content), file.name);
  return {std::string(cpp_record_name), std::move(record)};
}

}  // namespace spoolflow::exports

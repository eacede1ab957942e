/// `spoolflow export`: a model as something that other programs and controllers run; what an exported image of
/// parameters is, read back.
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/export/c_folder.hpp"
#include "spoolflow/export/cpp/overwriting.hpp"
#include "spoolflow/export/cpp_folder.hpp"
#include "spoolflow/export/fmu_archive.hpp"
#include "spoolflow/export/parameters/image_summary.hpp"
#include "spoolflow/export/parameters/parameter_image.hpp"
#include "spoolflow/export/sensor_fmu.hpp"
#include "spoolflow/export/st/st_program.hpp"
#include "spoolflow/export/valve_fmu.hpp"
#include "spoolflow/recording/file_format.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::apps {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string kind;
  std::string model;
  std::string output;
  std::string fmi;        ///< "2", "3"; empty: 2
  std::string direction;  ///< empty: all that the model has
  std::string sensors;    ///< of parameters: "observer", "condensed"; empty: both
  std::string target;     ///< of c: a core's name
  std::string valve;      ///< of ssp: a valve of the virtual rig
};

/// What is asked for of the model. Throws ModelError where it does not know that direction.
model::Model asked_model(const ExportArguments& arguments) {
  model::Model model = model::read_model(arguments.model);
  if (arguments.direction.empty() || model.valve.direction == arguments.direction) return model;
  if (model.whole()) return model::of_direction(model, arguments.direction);
  throw model::ModelError(fmt::format(
      "--direction {}: the model of {} knows direction {} alone; leave the option away, or calibrate the whole valve",
      arguments.direction, model.valve.name, model.valve.direction));
}

/// Of a model without the observer.
void say_without_observer(const model::Model& model, const char* result, const char* wanted) {
  if (model.has_observer()) return;
  say("{}: the model is not calibrated for the observer, so {}; calibrate with a solenoid_dynamic recording and an "
      "axial_force_map at two or more oil temperatures for {}\n",
      model.valve.name, result, wanted);
}

exports::ImageContents image_contents() {
  return {tool_version(), static_cast<std::uint64_t>(model::creation_seconds())};
}

std::vector<exports::ExportedFile> exported_folder(const ExportArguments& arguments, const model::Model& model) {
  if (arguments.kind == "cpp") return exports::cpp_folder(model);
  const std::optional<exports::FirmwareTarget> target = exports::firmware_target(arguments.target);
  if (!target) {
    std::string all;
    for (const exports::FirmwareTarget& each : exports::firmware_targets()) all += fmt::format(" {}", each.name);
    throw std::invalid_argument(
        fmt::format("--target '{}': name the core that the library is for:{}", arguments.target, all));
  }
  return exports::c_folder(model, *target, image_contents());
}

/// All files are written before the first one gets its name.
void export_folder(const ExportArguments& arguments) {
  const model::Model model = asked_model(arguments);
  const std::vector<exports::ExportedFile> files = exported_folder(arguments, model);
  const fs::path folder(arguments.output);
  if (folder.empty() || folder == "-") throw OutputError("an export needs a folder: name one after -o");
  const std::string refused = exports::why_not_to_overwrite(folder, files);
  if (!refused.empty()) throw OutputError(refused);
  Outputs outputs({arguments.model});
  for (const exports::ExportedFile& file : files) {
    make_output_folder((folder / file.name).parent_path());
    outputs.open(folder / file.name).stream() << file.content << std::flush;
  }
  outputs.commit();
  say_without_observer(model, "the condensed sensor alone is exported", "both");
}

/// A valve of the virtual rig rather than a model: a TOML file or the name of a preset.
bool names_valve(const std::string& name) {
  const auto& presets = rig::valve_presets();
  return name.ends_with(".toml") || std::ranges::find(presets, name) != presets.end();
}

/// Of what is neither: a model is asked for, and a valve may be meant.
void refuse_missing(const std::string& model_or_valve) {
  if (fs::exists(model_or_valve)) return;
  throw std::invalid_argument(fmt::format(
      "{}: is no file and no valve of the virtual rig; give a model from `spoolflow calibrate`, a valve file "
      "(TOML), or one of {}",
      model_or_valve, fmt::join(rig::valve_presets(), ", ")));
}

exports::FmiVersion fmi_version(const ExportArguments& arguments) {
  return arguments.fmi == "3" ? exports::FmiVersion::fmi3 : exports::FmiVersion::fmi2;
}

void export_ssp(const ExportArguments& arguments) {
  if (!exports::system_package()) {
    throw std::runtime_error(
        "export ssp needs the add-on 'cross', which this program is built without; in the sources `./run export ssp` "
        "builds it");
  }
  if (arguments.valve.empty())
    throw std::invalid_argument("--valve: name the virtual valve beside the sensor, as for fmu");
  const rig::ValveUnderTest valve = rig::read_valve_and_campaign(arguments.valve).valve;
  write_file(arguments.output, {arguments.model, arguments.valve},
             exports::system_package()(asked_model(arguments), valve, fmi_version(arguments), tool_version()));
}

void export_fmu(const ExportArguments& arguments) {
  if (!exports::windows_is_served()) {
    say("the FMU runs on this kind of machine alone: the add-on 'cross' brings libraries for Windows and Arm; in the "
        "sources `./run export fmu` builds it; or compile the FMU's sources there\n");
  }
  const exports::FmiVersion version = fmi_version(arguments);
  if (names_valve(arguments.model)) {
    if (!arguments.direction.empty()) {
      throw model::ModelError(fmt::format("--direction {}: a virtual valve has no direction to choose; leave it away",
                                          arguments.direction));
    }
    const rig::ValveUnderTest valve = rig::read_valve_and_campaign(arguments.model).valve;
    return write_file(arguments.output, {arguments.model}, exports::valve_fmu(valve, version, tool_version()));
  }
  refuse_missing(arguments.model);
  const model::Model model = asked_model(arguments);
  write_file(arguments.output, {arguments.model}, exports::sensor_fmu(model, version, tool_version()));
  say_without_observer(model, "the FMU runs the condensed sensor", "the observer");
}

void export_parameters(const ExportArguments& arguments) {
  const model::Model model = asked_model(arguments);
  exports::ImageContents contents = image_contents();
  contents.condensed = arguments.sensors != "observer";
  contents.observer = arguments.sensors != "condensed";
  write_file(arguments.output, {arguments.model}, exports::parameter_image(model, contents));
  if (contents.observer) say_without_observer(model, "the image holds the condensed sensor alone", "both");
  constexpr std::size_t room = sizeof sensor::ImageHeader::valve_name - 1;  // and a zero
  if (model.valve.name.size() > room) {
    say("{}: the image has room for {} of the name's {} bytes and holds its beginning; distinguish valves by the "
        "image's model_sha256, or shorten \"name\" in the model\n",
        model.valve.name, room, model.valve.name.size());
  }
}

void export_asked(const ExportArguments& arguments) {
  if (!arguments.sensors.empty() && arguments.kind != "parameters")
    throw std::invalid_argument(fmt::format("--sensors {}: of parameters alone; leave it away", arguments.sensors));
  if (!arguments.fmi.empty() && arguments.kind != "fmu" && arguments.kind != "ssp")
    throw std::invalid_argument(fmt::format("--fmi {}: of FMUs alone; leave it away", arguments.fmi));
  if (!arguments.valve.empty() && arguments.kind != "ssp")
    throw std::invalid_argument(fmt::format("--valve {}: of ssp alone; leave it away", arguments.valve));
  if (!arguments.target.empty() && arguments.kind != "c")
    throw std::invalid_argument(fmt::format("--target {}: of c alone; leave it away", arguments.target));
  if (arguments.kind == "fmu") return export_fmu(arguments);
  if (arguments.kind == "ssp") return export_ssp(arguments);
  if (arguments.kind == "cpp" || arguments.kind == "c") return export_folder(arguments);
  if (arguments.kind == "st")
    return write_file(arguments.output, {arguments.model}, exports::st_program(asked_model(arguments)));
  export_parameters(arguments);
}

/// Whether a file is an image of parameters, or would be one: what is named .bin, or holds nothing but what an erased
/// flash does and is not named as a recording. Standard input and pipes are not asked.
bool holds_image(const std::string& file) {
  std::error_code error;
  if (file == "-" || !std::filesystem::is_regular_file(file, error)) return false;
  std::ifstream in(file, std::ios::binary);
  std::array<char, sensor::image_header_bytes> beginning{};
  in.read(beginning.data(), beginning.size());
  const std::string_view read(beginning.data(), static_cast<std::size_t>(in.gcount()));
  return exports::begins_as_image(read) || fs::path(file).extension() == ".bin" ||
         (exports::is_erased(read) && !recording::format_by_ending(file));
}

template <std::size_t Room>
std::string field(const char (&text)[Room]) {
  return std::string(exports::field_text(text, Room));
}

void print_image(const std::string& file, const exports::ImageSummary& image) {
  const sensor::ImageHeader& header = image.header;
  if (!image.header_read) {
    print("{}: {} bytes, {}\n", file, image.file_bytes,
          image.erased ? "an erased page" : "no parameters of this version");
  } else {
    print("{}: parameters of {}, direction {}, for a flash page\n", file, field(header.valve_name),
          field(header.direction));
    print("layout version {}, header {} bytes, image {} bytes in a file of {}\n", header.layout_version,
          header.header_bytes, header.total_bytes, image.file_bytes);
    print("sensors: {}\n", exports::sensors_text(header));
    print("rated flow {:.5g} L/min, stroke {:.5g} mm\n",
          header.rated_flow_m3_per_s * units::litre_per_minute_per_m3_per_s,
          header.stroke_m * units::millimetre_per_metre);
    print("exported {} by spoolflow {}\n", exports::creation_text(header), field(header.tool_version));
    print("model sha256 {}\n\n", exports::sha256_text(header));
    print("{:<24} {:>9} {:>9}\n", "table", "offset", "bytes");
    for (const exports::ImageTableSummary& table : image.tables)
      print("{:<24} {:>9} {:>9}\n", table.name, table.offset, table.bytes);
    print("\nCRC-32 {:08X}, {}\n", header.crc32,
          image.crc32 == header.crc32 ? "as computed"
          : image.crc32 == 0          ? "not computed"
                                      : fmt::format("but computed {:08X}", image.crc32));
  }
  if (!image.problem.empty()) print("Its numbers break a limit of models: {}\n", image.problem);
  if (image.refusal == sensor::ImageRefusal::none) print("The sensor takes it.\n");
}

void print_image_json(const exports::ImageSummary& image) {
  using Json = nlohmann::ordered_json;
  const sensor::ImageHeader& header = image.header;
  Json tables = Json::array();
  for (const exports::ImageTableSummary& table : image.tables)
    tables.push_back({{"table", table.name}, {"offset", table.offset}, {"bytes", table.bytes}});
  print_text(json_text(Json{{"format", "parameters"},
                            {"erased", image.erased},
                            {"accepted", image.refusal == sensor::ImageRefusal::none},
                            {"refusal", static_cast<unsigned>(image.refusal)},
                            {"refusal_text", text_of(image.refusal)},
                            {"valve", field(header.valve_name)},
                            {"direction", field(header.direction)},
                            {"layout_version", header.layout_version},
                            {"image_bytes", header.total_bytes},
                            {"file_bytes", image.file_bytes},
                            {"rated_flow_m3_per_s", header.rated_flow_m3_per_s},
                            {"stroke_m", header.stroke_m},
                            {"created", exports::creation_text(header)},
                            {"tool_version", field(header.tool_version)},
                            {"model_sha256", exports::sha256_text(header)},
                            {"crc32", fmt::format("{:08X}", header.crc32)},
                            {"crc32_reckoned", fmt::format("{:08X}", image.crc32)},
                            {"problem", image.problem},
                            {"tables", tables}}));
}

}  // namespace

bool inspect_image(const std::string& file, bool json) {
  if (!holds_image(file)) return false;
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const exports::ImageSummary image = exports::image_summary(bytes);
  json ? print_image_json(image) : print_image(file, image);
  if (image.refusal != sensor::ImageRefusal::none) {
    throw std::invalid_argument(fmt::format("{}: the sensor refuses these parameters ({}): {}", file,
                                            static_cast<unsigned>(image.refusal), text_of(image.refusal)));
  }
  return true;
}

void add_export_command(CLI::App& program) {
  auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = add_command(
      program,
      {"export",
       "turn a model into something that other programs and controllers run",
       "MODEL.json from `spoolflow calibrate`; for fmu also a valve of the virtual rig: a valve file (TOML), or "
       "size_6, size_10, fast_dither, whole_size_6, whole_differential",
       "fmu: a co-simulation FMU of the sensor, or of the virtual valve, for Linux and Windows (64 bit; by FMI "
       "3.0 for Linux on 64-bit Arm, too), with sources. "
       "ssp: both FMUs in one file (SSP 1.0), connected with units. "
       "cpp: a folder "
       "with the sensor's headers, the model as constexpr numbers in single precision, an "
       "example and a self-test; files of an earlier export are replaced, all else in the folder stays. "
       "c: a folder with a static library for one core, its header in C99, a flash page, examples and a self-test. "
       "parameters: one file of bytes for a flash page, which firmware checks and reads where it lies; "
       "SOURCE_DATE_EPOCH "
       "sets the time in it. "
       "st: one file of IEC 61131-3 Structured Text, the condensed sensor as a function block with its tables",
       {"spoolflow export fmu valve_a.json -o sensor.fmu --fmi 3", "spoolflow export fmu size_6 -o valve.fmu --fmi 3",
        "spoolflow export ssp valve_a.json --valve size_6 -o valve_and_sensor.ssp",
        "spoolflow export cpp valve_a.json -o valve_a_cpp",
        "spoolflow export c valve_a.json --target cortex-m4f -o valve_a_c",
        "spoolflow export parameters valve_a.json -o valve.bin", "spoolflow export st valve_a.json -o valve.st"}});
  command
      ->add_option("kind", arguments->kind, "fmu, ssp: simulation; cpp, c: firmware; parameters: a flash page; st: PLC")
      ->required()
      ->check(CLI::IsMember({"fmu", "ssp", "cpp", "c", "parameters", "st"}));
  command->add_option("model", arguments->model, "model file; for fmu also a virtual valve")->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "file (fmu, ssp, parameters, st; - for standard output) or folder (cpp, c)")
      ->required();
  command->add_option("--fmi", arguments->fmi, "version of the FMI standard; every importer in use reads 2.0")
      ->check(CLI::IsMember({"2", "3"}))
      ->default_str("2");
  command
      ->add_option("--direction", arguments->direction,
                   "of a whole valve one direction alone: a (P to A) or b (P to B)")
      ->check(CLI::IsMember({"a", "b"}));
  command->add_option("--sensors", arguments->sensors, "of parameters: observer or condensed alone; without it both")
      ->check(CLI::IsMember({"observer", "condensed"}));
  command->add_option("--target", arguments->target,
                      "core of c: cortex-m4f, cortex-m7, cortex-m33, cortex-m3, cortex-m0plus");
  command->add_option("--valve", arguments->valve, "of ssp: the virtual valve beside the sensor, as for fmu");
  command->callback([arguments] { export_asked(*arguments); });
}

}  // namespace spoolflow::apps

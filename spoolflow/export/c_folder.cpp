#include "spoolflow/export/c_folder.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "spoolflow/export/cpp/exported_text.hpp"

namespace spoolflow::exports {
namespace {

constexpr std::array<FirmwareTarget, 5> targets{{
    {"cortex-m4f", "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16"},
    {"cortex-m7", "-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16"},
    {"cortex-m33", "-mcpu=cortex-m33 -mthumb -mfloat-abi=hard -mfpu=fpv5-sp-d16"},
    {"cortex-m3", "-mcpu=cortex-m3 -mthumb -mfloat-abi=soft"},
    {"cortex-m0plus", "-mcpu=cortex-m0plus -mthumb -mfloat-abi=soft"},
}};

constexpr std::string_view prefix = "cortex-";

bool is_for_c(const ExportedFile& file) {
  return file.name == "valve_sensor.h" || file.name == "example.c";
}

}  // namespace

std::span<const FirmwareTarget> firmware_targets() {
  return targets;
}

std::optional<FirmwareTarget> firmware_target(std::string_view name) {
  const auto found = std::ranges::find_if(targets, [name](const FirmwareTarget& each) {
    return each.name == name || each.name.substr(prefix.size()) == name;
  });
  return found == targets.end() ? std::nullopt : std::optional(*found);
}

FirmwareCompiler& firmware_compiler() {
  static FirmwareCompiler of_the_program;
  return of_the_program;
}

std::vector<ExportedFile> c_folder(const model::Model& model, const FirmwareTarget& target,
                                   const ImageContents& contents) {
  if (!firmware_compiler()) {
    throw std::runtime_error(
        "export c needs the add-on 'cross', which this program is built without; in the sources `./run export c` "
        "builds it, or take `export cpp`, which needs a C++ compiler for the core");
  }
  const std::vector<ExportedFile> sources = cpp_folder(model);
  std::vector<ExportedFile> files;
  std::copy_if(sources.begin(), sources.end(), std::back_inserter(files), is_for_c);
  files.push_back({"libvalve_sensor.a", firmware_compiler()(sources, target)});
  ImageContents of_the_sensor = contents;  // that the library runs
  of_the_sensor.condensed = !model.has_observer();
  files.push_back({"valve_page.bin", parameter_image(model, of_the_sensor)});
  files.push_back({"example_pages.c", exported_text("example_pages.c.in")});
  if (model.has_observer() && !model.whole())
    files.push_back({"example_references.c", exported_text("example_references.c.in")});
  files.push_back({"README.md", exported_text("c_README.md.in", {{"@VALVE@", model.valve.name},
                                                                 {"@TARGET@", std::string(target.name)},
                                                                 {"@OPTIONS@", std::string(target.options)}})});
  files.push_back(record_of(files));
  return files;
}

}  // namespace spoolflow::exports

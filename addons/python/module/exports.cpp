#include <algorithm>
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <stdexcept>

#include <fmt/format.h>

#include "addons/python/module/bindings.hpp"
#include "addons/python/module/models.hpp"
#include "addons/python/module/signal_check.hpp"
#include "spoolflow/export/cpp/overwriting.hpp"
#include "spoolflow/export/cpp_folder.hpp"
#include "spoolflow/export/parameters/parameter_image.hpp"
#include "spoolflow/export/sensor_fmu.hpp"
#include "spoolflow/export/valve_fmu.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::python {
namespace {

namespace py = pybind11;
using Direction = std::optional<std::string>;

/// Throws ModelError where the model does not know that direction.
model::Model asked_model(const KeptModel& kept, const Direction& direction) {
  if (!direction || kept.model.valve.direction == *direction) return kept.model;
  if (kept.model.whole()) return model::of_direction(kept.model, *direction);
  throw model::ModelError(fmt::format(
      "direction: the model of {} knows direction {} alone, not {}; leave it away, or calibrate the whole valve",
      kept.model.valve.name, kept.model.valve.direction, *direction));
}

exports::FmiVersion version_of(int fmi) {
  if (fmi != 2 && fmi != 3) throw std::invalid_argument(fmt::format("fmi: {} not in {{2,3}}", fmi));
  return fmi == 3 ? exports::FmiVersion::fmi3 : exports::FmiVersion::fmi2;
}

/// Names and contents. Throws std::invalid_argument where they must not be written into that folder.
std::vector<std::pair<std::string, py::bytes>> cpp_files(const SharedModel& kept, const std::filesystem::path& folder,
                                                         const Direction& direction) {
  const auto files = at_work([&](SignalCheck&) {
    auto made = exports::cpp_folder(asked_model(*kept, direction));
    const std::string refused = exports::why_not_to_overwrite(folder, made);
    if (!refused.empty()) throw std::invalid_argument(refused);
    return made;
  });
  std::vector<std::pair<std::string, py::bytes>> out;
  for (const exports::ExportedFile& file : files) out.emplace_back(file.name, py::bytes(file.content));
  return out;
}

py::bytes parameters(const SharedModel& kept, const Direction& direction, const std::optional<std::string>& sensors) {
  if (sensors && *sensors != "observer" && *sensors != "condensed")
    throw std::invalid_argument(fmt::format("sensors: {} not in {{observer,condensed}}", *sensors));
  return py::bytes(at_work([&](SignalCheck&) {
    exports::ImageContents contents{SPOOLFLOW_VERSION, static_cast<std::uint64_t>(model::creation_seconds())};
    contents.condensed = sensors != "observer";
    contents.observer = sensors != "condensed";
    return exports::parameter_image(asked_model(*kept, direction), contents);
  }));
}

py::bytes sensor_fmu(const SharedModel& kept, int fmi, const Direction& direction) {
  return py::bytes(at_work([&](SignalCheck&) {
    return exports::sensor_fmu(asked_model(*kept, direction), version_of(fmi), SPOOLFLOW_VERSION);
  }));
}

py::bytes valve_fmu(const std::string& valve, int fmi) {
  return py::bytes(at_work([&](SignalCheck&) {
    return exports::valve_fmu(rig::read_valve_and_campaign(valve).valve, version_of(fmi), SPOOLFLOW_VERSION);
  }));
}

/// A valve of the virtual rig rather than a model: a TOML file or the name of a preset.
bool names_valve(const std::string& name) {
  const auto& presets = rig::valve_presets();
  return name.ends_with(".toml") || std::find(presets.begin(), presets.end(), name) != presets.end();
}

}  // namespace

void add_exports(py::module_& module) {
  module.def("export_cpp", &cpp_files);
  module.def("export_parameters", &parameters);
  module.def("export_sensor_fmu", &sensor_fmu);
  module.def("export_valve_fmu", &valve_fmu);
  module.def("names_valve", &names_valve);
}

}  // namespace spoolflow::python

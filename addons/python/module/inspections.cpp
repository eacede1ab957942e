#include <filesystem>
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string>

#include "addons/python/module/bindings.hpp"
#include "addons/python/module/signal_check.hpp"
#include "spoolflow/apps/work/inspection_text.hpp"
#include "spoolflow/recording/inspection.hpp"

namespace spoolflow::python {
namespace {

/// What `inspect --json` writes of the file.
std::string inspect(const std::filesystem::path& file, const std::optional<std::filesystem::path>& channels,
                    const std::optional<double>& stroke_m) {
  return at_work([&](SignalCheck& check) {
    recording::ReadOptions options;
    if (channels) options.channels = recording::read_channel_map(*channels);
    options.stroke_m = stroke_m;
    return apps::inspection_json(
        recording::inspect(file, options, [&](std::optional<double>, std::uint64_t) { check(); }));
  });
}

}  // namespace

void add_inspections(pybind11::module_& module) {
  module.def("inspect", &inspect);
}

}  // namespace spoolflow::python

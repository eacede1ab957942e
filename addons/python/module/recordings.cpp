#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "addons/python/module/bindings.hpp"
#include "addons/python/module/read_recording.hpp"
#include "addons/python/module/signal_check.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "spoolflow/rig/bench/scenario.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::python {
namespace {

namespace py = pybind11;
using recording::Channel;
using recording::Recording;

}  // namespace

std::string column_name(Channel channel) {
  std::string name(recording::name(channel));
  switch (recording::dimension(channel)) {
    case units::Dimension::time:
      return name + "_s";
    case units::Dimension::current:
      return name + "_A";
    case units::Dimension::voltage:
      return name + "_V";
    case units::Dimension::length:
      return name + "_m";
    case units::Dimension::force:
      return name + "_N";
    case units::Dimension::pressure:
      return name + "_Pa";
    case units::Dimension::temperature:
      return name + "_K";
    case units::Dimension::volume_flow:
      return name + "_m3_per_s";
    default:
      return name;  // shares and numbers of tests
  }
}

namespace {

std::shared_ptr<ReadRecording> read(const std::filesystem::path& file,
                                    const std::optional<std::filesystem::path>& channels,
                                    const std::optional<double>& stroke_m) {
  return at_work([&](SignalCheck& check) {
    return read_whole(*recording::open_reader(file, every_channel(channels, stroke_m)), file, check);
  });
}

/// By their names; no copies: an array keeps the recording.
py::dict columns_of(const std::shared_ptr<ReadRecording>& read) {
  py::dict out;
  const py::object keeper = py::cast(read);
  for (const Channel channel : recording::all_channels) {
    const std::vector<double>& column = read->recording.column(channel);
    if (column.empty()) continue;
    out[py::str(column_name(channel))] =
        py::array_t<double>(static_cast<py::ssize_t>(column.size()), column.data(), keeper);
  }
  return out;
}

py::dict notes_of(const ReadRecording& read) {
  py::dict out;
  out["samples"] = read.notes.rows;
  out["duplicate_times"] = read.notes.duplicate_times;
  out["missing_values"] = read.notes.missing_values();
  out["resampled"] = read.notes.resampled;
  return out;
}

py::tuple simulate(const std::filesystem::path& scenario, bool with_truth, const py::object& progress) {
  const auto simulated = at_work([&](SignalCheck& check) {
    const rig::PlannedScenario planned = rig::plan(rig::read_scenario(scenario));
    return rig::simulate(planned.valve, planned.run, planned.valve.seed,
                         {.with_truth = with_truth, .progress = [&](double share) { check(progress, share); }});
  });
  return simulated_objects(simulated, scenario);
}

/// For another process.
py::tuple packed(const ReadRecording& read) {
  py::list columns;
  for (const std::vector<double>& column : read.recording.columns)
    columns.append(py::bytes(reinterpret_cast<const char*>(column.data()), column.size() * sizeof(double)));
  const recording::ReadNotes& notes = read.notes;
  return py::make_tuple(read.recording.file, columns, notes.rows, notes.duplicate_times, notes.missing,
                        notes.resampled);
}
std::shared_ptr<ReadRecording> unpacked(const py::tuple& state) {
  auto out = std::make_shared<ReadRecording>();
  out->recording.file = state[0].cast<std::filesystem::path>();
  const auto columns = state[1].cast<py::list>();
  for (std::size_t k = 0; k < recording::channel_count; ++k) {
    const auto bytes = columns[k].cast<std::string_view>();
    std::vector<double>& column = out->recording.columns[k];
    column.resize(bytes.size() / sizeof(double));
    if (!column.empty()) std::memcpy(column.data(), bytes.data(), bytes.size());
  }
  out->notes = {.rows = state[2].cast<std::uint64_t>(),
                .duplicate_times = state[3].cast<std::uint64_t>(),
                .missing = state[4].cast<decltype(recording::ReadNotes::missing)>(),
                .resampled = state[5].cast<std::string>()};
  out->recording.resampled = out->notes.resampled;
  return out;
}

}  // namespace

recording::ReadOptions every_channel(const std::optional<std::filesystem::path>& channels,
                                     const std::optional<double>& stroke_m) {
  recording::ReadOptions options;
  if (channels) options.channels = recording::read_channel_map(*channels);
  options.required = {Channel::time};
  for (const Channel channel : recording::all_channels) {
    if (channel != Channel::time) options.optional.push_back(channel);
  }
  options.stroke_m = stroke_m;
  return options;
}

std::shared_ptr<ReadRecording> read_whole(recording::Reader& reader, const std::filesystem::path& file,
                                          SignalCheck& check) {
  auto out = std::make_shared<ReadRecording>();
  out->recording.file = file;
  recording::SampleBlock block;
  while (reader.next(block)) {
    check();
    for (const Channel channel : recording::all_channels) {
      const std::vector<double>& rows = block.column(channel);
      std::vector<double>& column = out->recording.column(channel);
      column.insert(column.end(), rows.begin(), rows.end());
    }
  }
  out->notes = reader.notes();
  out->recording.resampled = out->notes.resampled;
  return out;
}

py::tuple simulated_objects(const rig::Simulation& simulation, const std::filesystem::path& file) {
  auto out = std::make_shared<ReadRecording>();
  out->recording = simulation.recording;
  out->recording.file = file;
  out->notes.rows = out->recording.size();
  if (simulation.truth.size() == 0) return py::make_tuple(out, py::none());
  py::dict truth;
  for (std::size_t k = 0; k < simulation.truth.columns.size(); ++k) {
    const std::vector<double>& column = simulation.truth.columns[k];
    truth[py::str(std::string(simulation.truth.quantities[k].header))] =
        py::array_t<double>(static_cast<py::ssize_t>(column.size()), column.data());
  }
  return py::make_tuple(out, truth);
}

void add_recordings(py::module_& module) {
  py::class_<ReadRecording, std::shared_ptr<ReadRecording>>(module, "Recording")
      .def("columns", [](const std::shared_ptr<ReadRecording>& self) { return columns_of(self); })
      .def("notes", [](const ReadRecording& self) { return notes_of(self); })
      .def(py::pickle(&packed, &unpacked));
  py::list channels;
  for (const Channel channel : recording::all_channels) channels.append(std::string(recording::name(channel)));
  module.attr("channels") = channels;
  py::list columns;
  for (const Channel channel : recording::all_channels) columns.append(column_name(channel));
  module.attr("columns") = columns;
  module.def("read_recording", &read);
  module.def("simulate", &simulate);
  module.def("takes_a_process", [](const std::vector<std::filesystem::path>& files) {
    return std::any_of(files.begin(), files.end(), recording::takes_a_process);
  });
}

}  // namespace spoolflow::python

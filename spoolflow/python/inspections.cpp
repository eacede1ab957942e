#include <filesystem>
#include <optional>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string>

#include "spoolflow/python/bindings.hpp"
#include "spoolflow/python/signal_check.hpp"
#include "spoolflow/recording/inspection.hpp"
#include "spoolflow/recording/proposal.hpp"

namespace spoolflow::python {
namespace {

namespace py = pybind11;

py::str text(recording::Channel channel) {
  return std::string(recording::name(channel));
}

py::list names(const std::vector<recording::Channel>& channels) {
  py::list out;
  for (const recording::Channel channel : channels) out.append(text(channel));
  return out;
}

py::list channels_of(const recording::Inspection& found) {
  py::list out;
  for (const recording::ChannelSummary& each : found.channels) {
    py::dict channel;
    channel["channel"] = text(each.channel);
    channel["lowest"] = each.lowest;
    channel["highest"] = each.highest;
    channel["mean"] = each.mean;
    channel["missing"] = each.missing;
    channel["clipped_share"] = each.clipped;
    out.append(channel);
  }
  return out;
}

py::list columns_of(const recording::Inspection& found) {
  py::list out;
  for (const recording::InspectedColumn& each : found.columns) {
    py::dict column;
    column["column"] = each.name;
    column["unit"] = each.unit;
    column["lowest"] = each.lowest;
    column["highest"] = each.highest;
    column["channel"] = each.channel ? py::object(text(*each.channel)) : py::object(py::none());
    column["guessed"] = each.guessed;
    column["why"] = each.why;
    out.append(column);
  }
  return out;
}

py::list times_of(const recording::Inspection& found) {
  py::list out;
  for (const recording::InspectedClock& each : found.clocks) {
    py::dict time;
    time["column"] = each.time;
    time["samples"] = each.samples;
    time["rate_Hz"] = each.rate_Hz;
    time["begin_s"] = each.begin_s;
    time["end_s"] = each.end_s;
    time["leads"] = each.leads;
    time["fault"] = each.fault;
    time["columns"] = each.columns;
    out.append(time);
  }
  return out;
}

/// A map that read_recording() takes.
py::dict map_of(const recording::ChannelMap& proposal) {
  py::dict out;
  for (const auto& [channel, source] : proposal.sources) {
    py::dict entry;
    entry["column"] = source.column;
    entry["unit"] = source.unit;
    if (source.scale != 1.0) entry["scale"] = source.scale;
    if (source.offset != 0.0) entry["offset"] = source.offset;
    if (source.to) entry["to"] = *source.to;
    out[text(channel)] = entry;
  }
  return out;
}

py::dict inspect(const std::filesystem::path& file, const std::optional<std::filesystem::path>& channels,
                 const std::optional<double>& stroke_m) {
  const recording::Inspection found = at_work([&](SignalCheck& check) {
    recording::ReadOptions options;
    if (channels) options.channels = recording::read_channel_map(*channels);
    options.stroke_m = stroke_m;
    return recording::inspect(file, options, [&](std::optional<double>, std::uint64_t) { check(); });
  });
  py::dict out;
  out["format"] = found.contents.format;
  out["columns"] = found.contents.columns;
  out["samples"] = found.samples;
  out["begin_s"] = found.begin_s;
  out["end_s"] = found.end_s;
  out["rate_Hz"] = found.rate_Hz;
  out["time_step_jitter"] = found.jitter;
  out["duplicate_times"] = found.duplicate_times;
  out["gap_count"] = found.gap_count;
  py::list gaps;
  for (const recording::Gap& gap : found.gaps) gaps.append(py::make_tuple(gap.from_s, gap.to_s));
  out["gaps_s"] = gaps;
  out["channels"] = channels_of(found);
  out["raw_columns"] = columns_of(found);
  out["times"] = times_of(found);
  out["resampled"] = found.resampled;
  out["missing"] = names(found.missing);
  out["helpful"] = names(found.helpful);
  out["proposed_map"] = map_of(found.proposal);
  out["proposed_text"] = recording::written(found.proposal, found.remarks, found.missing);
  return out;
}

}  // namespace

void add_inspections(py::module_& module) {
  module.def("inspect", &inspect);
}

}  // namespace spoolflow::python

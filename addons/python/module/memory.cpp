#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "addons/python/module/bindings.hpp"
#include "addons/python/module/read_recording.hpp"
#include "addons/python/module/signal_check.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/header_name.hpp"
#include "spoolflow/recording/files/vector_table.hpp"
#include "spoolflow/recording/memory_reader.hpp"

namespace spoolflow::python {
namespace {

namespace py = pybind11;
using GivenNumbers = py::array_t<double, py::array::c_style>;
using SampleNumbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

/// A column by its name; without numbers where it holds something else.
struct GivenColumn {
  std::string name;
  std::span<const double> numbers;
  std::size_t length;
};

/// The unit beside the name of a column that a Recording has without one: shares are shares.
std::string unit_beside(std::string_view name) {
  const auto channels = recording::all_channels;
  const bool share = std::any_of(channels.begin(), channels.end(), [&](recording::Channel channel) {
    return recording::dimension(channel) == units::Dimension::ratio && name == recording::name(channel);
  });
  return share ? "1" : "";
}

/// Columns in memory as those of a file of separate vectors.
class MemoryTable final : public recording::VectorTable {
 public:
  MemoryTable(const std::vector<GivenColumn>& columns, const std::string& name)
      : VectorTable(name), given_(columns), name_(name) {
    for (const GivenColumn& each : given_) add({{each.name, each.name, unit_beside(each.name)}, each.length});
  }
  void copy(std::size_t column, std::uint64_t first, std::size_t count, double* out) override {
    const GivenColumn& from = given_[column];
    if (from.numbers.size() != from.length) {
      throw recording::RecordingError(
          fmt::format("{}: '{}' holds what is no number; give numbers, NaN where one is missing", name_, from.name));
    }
    std::memcpy(out, from.numbers.data() + first, count * sizeof(double));
  }

 private:
  std::vector<GivenColumn> given_;
  std::string name_;
};

/// `columns`: name, numbers or None, length; in their order. `name` stands in messages.
std::shared_ptr<ReadRecording> as_recording(const py::list& columns, const std::string& name,
                                            const std::optional<std::filesystem::path>& channels,
                                            const std::optional<double>& stroke_m) {
  std::vector<GivenNumbers> kept;
  std::vector<GivenColumn> given;
  for (const py::handle each : columns) {
    const auto column = each.cast<py::tuple>();
    GivenColumn out{column[0].cast<std::string>(), {}, column[2].cast<std::size_t>()};
    if (!column[1].is_none()) {
      kept.push_back(column[1].cast<GivenNumbers>());
      out.numbers = {kept.back().data(), static_cast<std::size_t>(kept.back().size())};
    }
    given.push_back(std::move(out));
  }
  return at_work([&](SignalCheck& check) {
    const auto open = [&] { return std::make_unique<MemoryTable>(given, name); };
    const auto reader = recording::open_reader(open, every_channel(channels, stroke_m), name);
    return read_whole(*reader, name, check);
  });
}

/// CSV with every digit, by the names of the columns; NaN is an empty cell.
void write_recording(const ReadRecording& read, const std::filesystem::path& file) {
  at_work([&](SignalCheck& check) {
    std::vector<const std::vector<double>*> columns;
    fmt::memory_buffer text;
    for (const recording::Channel channel : recording::all_channels) {
      if (read.recording.column(channel).empty()) continue;
      const std::string name = column_name(channel), unit = unit_beside(name);
      fmt::format_to(std::back_inserter(text), "{}{}{}{}", columns.empty() ? "" : ",", name, unit.empty() ? "" : "_",
                     unit);
      columns.push_back(&read.recording.column(channel));
    }
    std::ofstream out(file, std::ios::binary);
    constexpr std::size_t at_once = 1 << 16;
    for (std::size_t row = 0; row < read.recording.size(); ++row) {
      text.push_back('\n');
      for (std::size_t k = 0; k < columns.size(); ++k) {
        if (k > 0) text.push_back(',');
        if (const double value = (*columns[k])[row]; value == value)
          fmt::format_to(std::back_inserter(text), "{}", value);
      }
      if (text.size() < at_once) continue;
      check();
      out.write(text.data(), static_cast<std::streamsize>(text.size()));
      text.clear();
    }
    text.push_back('\n');
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    if (!out) throw std::invalid_argument(fmt::format("{}: cannot be written; is there room?", file.string()));
  });
}

/// These samples, by their numbers from 0 on, which must be there.
std::shared_ptr<ReadRecording> picked(const ReadRecording& read, const SampleNumbers& samples) {
  auto out = std::make_shared<ReadRecording>(ReadRecording{{}, read.notes});
  out->recording.file = read.recording.file;
  out->recording.resampled = read.recording.resampled;
  out->notes.rows = static_cast<std::uint64_t>(samples.size());
  for (const recording::Channel channel : recording::all_channels) {
    const std::vector<double>& from = read.recording.column(channel);
    std::vector<double>& to = out->recording.column(channel);
    if (from.empty()) continue;
    to.reserve(static_cast<std::size_t>(samples.size()));
    for (py::ssize_t k = 0; k < samples.size(); ++k) to.push_back(from.at(static_cast<std::size_t>(samples.data()[k])));
  }
  return out;
}

/// Whether a column of that name is some channel's, in whatever unit.
bool names_channel(const std::string& column) {
  return recording::channel_header({column, column, unit_beside(column)}).has_value();
}

}  // namespace

void add_memory(py::module_& module) {
  module.def("as_recording", &as_recording);
  module.def("write_recording", &write_recording);
  module.def("names_channel", &names_channel);
  module.def("picked", &picked);
}

}  // namespace spoolflow::python

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <ostream>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <span>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <unistd.h>
#include <vector>

#include "addons/python/module/bindings.hpp"
#include "addons/python/module/signal_check.hpp"
#include "spoolflow/apps/work/estimate_table.hpp"
#include "spoolflow/recording/written_tables/table_writers.hpp"

namespace spoolflow::python {
namespace {

namespace py = pybind11;
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

[[noreturn]] void refuse() {
  throw std::invalid_argument(std::strerror(errno));
}

/// A file that the package has opened, at places.
class FilePlaces : public recording::PlacedBytes {
 public:
  explicit FilePlaces(int descriptor) : descriptor_(descriptor) {}

  void write(std::uint64_t at, std::span<const std::uint8_t> bytes) override {
    while (!bytes.empty()) {
      const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
      if (written < 0 && errno != EINTR) refuse();
      const auto count = static_cast<std::size_t>(std::max<ssize_t>(written, 0));
      bytes = bytes.subspan(count);
      at += count;
    }
  }
  void read(std::uint64_t at, std::span<std::uint8_t> bytes) override {
    while (!bytes.empty()) {
      const ssize_t got = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
      if (got < 0 && errno != EINTR) refuse();
      if (got == 0) break;
      const auto count = static_cast<std::size_t>(std::max<ssize_t>(got, 0));
      bytes = bytes.subspan(count);
      at += count;
    }
    std::fill(bytes.begin(), bytes.end(), std::uint8_t{0});
  }

 private:
  int descriptor_;
};

/// From the file's beginning on.
class SequenceBuffer : public std::streambuf {
 public:
  explicit SequenceBuffer(FilePlaces& file) : file_(file) {}

 protected:
  std::streamsize xsputn(const char* from, std::streamsize count) override {
    file_.write(at_, {reinterpret_cast<const std::uint8_t*>(from), static_cast<std::size_t>(count)});
    at_ += static_cast<std::uint64_t>(count);
    return count;
  }
  int_type overflow(int_type next) override {
    const char letter = traits_type::to_char_type(next);
    return xsputn(&letter, 1) == 1 ? next : traits_type::eof();
  }

 private:
  FilePlaces& file_;
  std::uint64_t at_ = 0;
};

/// The table to be, and room beside it.
class Files : public recording::TableOutput {
 public:
  Files(int file, int beside) : places_(file), scratch_(beside) {
    stream_.exceptions(std::ios::badbit);  // lets the file's own exception through
  }
  std::ostream& in_sequence() override { return stream_; }
  recording::PlacedBytes& in_places() override { return places_; }
  recording::PlacedBytes& scratch() override { return scratch_; }

 private:
  FilePlaces places_, scratch_;
  SequenceBuffer buffer_{places_};
  std::ostream stream_{&buffer_};
};

constexpr std::array answers{
    &sensor::Estimate<double>::flow_m3_per_s,       &sensor::Estimate<double>::flow_lower_m3_per_s,
    &sensor::Estimate<double>::flow_upper_m3_per_s, &sensor::Estimate<double>::pressure_difference_Pa,
    &sensor::Estimate<double>::magnetic_force_N,    &sensor::Estimate<double>::flow_force_N,
    &sensor::Estimate<double>::friction_force_N};

/// `columns`: the times, then those of `answers`. `name`: of the file to be, which decides the format; `file`,
/// `beside`: descriptors of empty files.
void write_estimate(const std::filesystem::path& name, int file, int beside, const std::vector<Numbers>& columns,
                    const py::array_t<std::uint32_t, py::array::c_style | py::array::forcecast>& status,
                    const std::vector<std::pair<std::string, std::string>>& notes) {
  const auto rows = static_cast<std::size_t>(status.size());
  const bool alike =
      std::all_of(columns.begin(), columns.end(), [&](const Numbers& each) { return each.size() == status.size(); });
  if (columns.size() != answers.size() + 1 || !alike) throw std::invalid_argument("columns of unequal length");
  std::vector<const double*> numbers;
  for (const Numbers& column : columns) numbers.push_back(column.data());
  const std::uint32_t* const words = status.data();
  at_work([&](SignalCheck& check) {
    recording::TableHead head = apps::estimate_table();
    head.notes = notes;
    Files files(file, beside);
    const auto writer = recording::table_writer(recording::table_format_of(name), std::move(head), files);
    constexpr std::size_t at_once = 4096;
    std::vector<sensor::Estimate<double>> estimates;
    recording::TableRows table;
    for (std::size_t from = 0; from < rows; from += at_once) {
      check();
      const std::size_t count = std::min(at_once, rows - from);
      estimates.resize(count);
      for (std::size_t row = 0; row < count; ++row) {
        for (std::size_t k = 0; k < answers.size(); ++k) estimates[row].*(answers[k]) = numbers[k + 1][from + row];
        estimates[row].status = static_cast<sensor::Status>(words[from + row]);
      }
      apps::put_estimates(table, {numbers[0] + from, count}, estimates);
      writer->write(table);
    }
    writer->finish();
  });
}

}  // namespace

void add_tables(py::module_& module) {
  module.def("write_estimate", &write_estimate);
}

}  // namespace spoolflow::python

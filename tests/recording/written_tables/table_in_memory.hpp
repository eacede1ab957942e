#pragma once
/// A small table and an output that keeps its bytes, for the tests of writers.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/numerics/little_endian.hpp"
#include "spoolflow/recording/written_tables/table_writers.hpp"

namespace spoolflow::recording {

class BytesInMemory : public PlacedBytes {
 public:
  void write(std::uint64_t at, std::span<const std::uint8_t> from) override {
    if (limit && at + from.size() > *limit) throw std::runtime_error("the disk is full");
    bytes.resize(std::max(bytes.size(), at + from.size()));
    std::copy(from.begin(), from.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
  }
  void read(std::uint64_t at, std::span<std::uint8_t> to) override {
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = at + k < bytes.size() ? bytes[at + k] : 0;
  }
  std::vector<std::uint8_t> bytes;
  std::optional<std::size_t> limit;
};

class OutputInMemory : public TableOutput {
 public:
  std::ostream& in_sequence() override { return stream; }
  PlacedBytes& in_places() override { return places; }
  PlacedBytes& scratch() override { return beside; }
  [[nodiscard]] std::vector<std::uint8_t> bytes() const {
    const std::string text = stream.str();
    return {text.begin(), text.end()};
  }
  std::ostringstream stream;
  BytesInMemory places, beside;
};

inline TableHead small_head() {
  TableHead head{.name = "run", .numbers = {}, .flags = "status", .flag_names = {}, .flag_text = {}, .notes = {}};
  head.numbers = {{"time_s", "s", "time", 3}, {"flow_L_min", "L/min", "flow rate", 2}};
  head.flag_names = {{1, "closed"}, {4, "held"}};
  head.flag_text = [](std::uint32_t word) -> std::string_view {
    return word == 0 ? "" : word == 1 ? "closed" : word == 4 ? "held" : "closed|held";
  };
  head.notes = {{"valve", "A"}};
  return head;
}

inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// -0.5 s, 0 s, no time; flow 1/3, none, 2.5; well, closed and held, held.
inline TableRows small_rows() {
  return {{{-0.5, 0.0, none}, {1.0 / 3.0, none, 2.5}}, {0, 5, 4}};
}

/// The bytes that `small_rows()` become, written as one block and as one a row.
inline std::vector<std::uint8_t> small_table(TableFormat format) {
  std::vector<std::uint8_t> whole;
  for (const bool by_row : {false, true}) {
    OutputInMemory output;
    const auto writer = table_writer(format, small_head(), output);
    const TableRows rows = small_rows();
    if (!by_row) writer->write(rows);
    for (std::size_t k = 0; by_row && k < rows.count(); ++k)
      writer->write({{{rows.numbers[0][k]}, {rows.numbers[1][k]}}, {rows.flags[k]}});
    writer->finish();
    std::vector<std::uint8_t> bytes = format == TableFormat::hdf5 ? output.places.bytes : output.bytes();
    if (by_row && bytes != whole) throw std::logic_error("blocks of other lengths give other bytes");
    whole = std::move(bytes);
  }
  return whole;
}

}  // namespace spoolflow::recording

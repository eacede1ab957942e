#pragma once
/// What must hold for every file of samples, whatever its bytes: it is read, or refused by a RecordingError.
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/inspection.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "spoolflow/recording/proposal.hpp"
#include "tests/fuzz/input_file.hpp"

namespace spoolflow::fuzz {

/// The last column's first numbers: none is infinite, and each read gives at most what there is room for.
inline void read_a_column(const std::filesystem::path& path) {
  constexpr std::size_t room = 64, most_reads = 20;
  const auto table = recording::open_sample_table(path, recording::CsvTable::Text::counted).table;
  if (table->columns().empty()) return;
  table->select({table->columns().size() - 1});
  std::vector<double> values(room);
  double* const out[1]{values.data()};
  for (std::size_t k = 0; k < most_reads; ++k) {
    const std::size_t rows = table->read(out, room);
    require(rows <= room);
    for (std::size_t row = 0; row < rows; ++row) require(!std::isinf(values[row]));
    if (rows == 0) break;
    require(!table->place(rows - 1).empty());
  }
}

/// As `spoolflow inspect` reads it, by its own names and by the map that is proposed for it.
inline void inspect_file(const std::filesystem::path& path) {
  const auto no_progress = [](std::optional<double>, std::uint64_t) {};
  const recording::Inspection found = recording::inspect(path, {}, no_progress);
  recording::ReadOptions by_map;
  by_map.channels = found.proposal;
  by_map.stroke_m = 2e-3;
  require(!recording::written(found.proposal).empty());
  if (!found.proposal.sources.empty()) (void)recording::inspect(path, by_map, no_progress);
}

template <class Work>
void read_or_refuse(Work&& work) {
  try {
    work();
  } catch (const recording::RecordingError& error) {
    require(error.what()[0] != '\0');
  }
}

/// Bytes as a file that the process for HDF5 and MATLAB files reads; others are left to the target of CSV.
inline void read_in_child(const InputFile& file, const std::uint8_t* data, std::size_t size) {
  read_or_refuse([&] {
    const auto format = recording::format_of({reinterpret_cast<const char*>(data), size}, file.path());
    if (format == recording::FileFormat::csv) return;
    file.write(data, size);
    read_a_column(file.path());
  });
}

}  // namespace spoolflow::fuzz

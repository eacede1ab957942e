#pragma once
/// What must hold for every file of vectors whose reader is our own, whatever its bytes: each column is read to its
/// end, or refused by a RecordingError. Without a process in a sandbox, so that the coverage is seen.
#include <algorithm>
#include <cmath>
#include <new>
#include <vector>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/files/confined_table.hpp"
#include "tests/fuzz/input_file.hpp"

namespace spoolflow::fuzz {

inline void read_vectors(const InputFile& file, const std::uint8_t* data, std::size_t size,
                         recording::OpenVectors open) {
  constexpr std::size_t most_columns = 16, room = 512, most_reads = 64;
  file.write(data, size);
  try {
    const auto opened = open(file.path());
    opened->look();
    const std::size_t columns = opened->columns().size();
    std::vector<double> values(room);
    double* const out[1]{values.data()};
    for (std::size_t k = 0; k < std::min(columns, most_columns); ++k) {
      try {
        const auto table = open(file.path());
        table->look();
        table->select({k});
        std::size_t rows = 1;
        for (std::size_t reads = 0; reads < most_reads && rows > 0; ++reads) {
          rows = table->read(out, room);
          require(rows <= room);
          for (std::size_t row = 0; row < rows; ++row) require(!std::isinf(values[row]));
        }
      } catch (const recording::RecordingError& error) {
        require(error.what()[0] != '\0');
      }
    }
  } catch (const recording::RecordingError& error) {
    require(error.what()[0] != '\0');
  } catch (const std::bad_alloc&) {  // the child has a limit of memory, and reports it
  }
}

}  // namespace spoolflow::fuzz

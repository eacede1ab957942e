#pragma once
/// What a recording that was made byte by byte holds in one of its columns.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "spoolflow/recording/open_table.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {

/// All samples, at most 64, of the column of that name; read as any recording is, from a file of the name `file`.
inline std::vector<double> column_of(const std::string& file, const std::string& bytes, const std::string& name) {
  const TemporaryFile written(file, bytes);
  const auto table = open_sample_table(written.path()).table;
  for (std::size_t k = 0; k < table->columns().size(); ++k) {
    if (table->columns()[k].name != name) continue;
    table->select({k});
    std::vector<double> out(64);
    std::size_t count = 0;
    for (std::size_t rows = 1; rows > 0; count += rows) {
      double* const next[1]{out.data() + count};
      rows = table->read(next, out.size() - count);
    }
    out.resize(count);
    return out;
  }
  ADD_FAILURE() << "no column " << name;
  return {};
}

}  // namespace spoolflow::recording

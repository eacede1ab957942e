#pragma once
/// Measured data of others (../shared/public: origin and licence are in each folder's SOURCE.md), not part of this
/// project.
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "spoolflow/recording/open_table.hpp"

namespace spoolflow::public_data {

/// SPOOLFLOW_PUBLIC_DATA of the environment, else as configured.
inline std::filesystem::path folder() {
  const char* chosen = std::getenv("SPOOLFLOW_PUBLIC_DATA");
  return chosen != nullptr ? chosen : SPOOLFLOW_PUBLIC_DATA;
}

/// The named columns of a file, whole.
inline std::vector<std::vector<double>> columns(const std::filesystem::path& file,
                                                const std::vector<std::string>& names) {
  const auto table = recording::open_sample_table(file).table;
  std::vector<std::size_t> chosen;
  for (const std::string& name : names) {
    std::size_t found = 0;
    while (found < table->columns().size() && table->columns()[found].name != name) ++found;
    if (found == table->columns().size()) throw std::invalid_argument(file.string() + " has no column " + name);
    chosen.push_back(found);
  }
  table->select(chosen);
  constexpr std::size_t block = 4096;
  std::vector<std::vector<double>> out(names.size());
  for (std::size_t rows = block; rows > 0;) {
    std::vector<double*> places;
    const std::size_t before = out.front().size();
    for (std::vector<double>& column : out) {
      column.resize(before + block);
      places.push_back(column.data() + before);
    }
    rows = table->read(places, block);
    for (std::vector<double>& column : out) column.resize(before + rows);
  }
  return out;
}

/// Tests on one folder of the data; skipped, with the reason, where it is not there.
class PublicData : public testing::Test {
 public:
  explicit PublicData(const char* name) : data(folder() / name) {}

 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(data))
      GTEST_SKIP() << data.string() << " is not there; name the folder of the public data in SPOOLFLOW_PUBLIC_DATA";
  }
  std::filesystem::path data;
};

}  // namespace spoolflow::public_data

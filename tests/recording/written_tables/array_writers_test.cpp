/// HDF5 and MATLAB files of the writers, read by this project's reader and by the libraries.
#include <fstream>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <matio.h>

#include "spoolflow/recording/files/hdf5_table.hpp"
#include "spoolflow/recording/matlab/mat_table.hpp"
#include "tests/recording/temporary_file.hpp"
#include "tests/recording/written_tables/table_in_memory.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::NanSensitiveDoubleEq;
using Bytes = std::vector<std::uint8_t>;

std::string text_of(const Bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

std::vector<double> values(VectorTable& table, const std::string& name, std::size_t count) {
  for (std::size_t k = 0; k < table.columns().size(); ++k) {
    if (table.columns()[k].name != name) continue;
    std::vector<double> out(count);
    table.copy(k, 0, count, out.data());
    return out;
  }
  ADD_FAILURE() << "no column " << name;
  return {};
}

void expect_small_rows(VectorTable& table) {
  EXPECT_THAT(values(table, "time_s", 3), ElementsAre(-0.5, 0.0, NanSensitiveDoubleEq(none)));
  EXPECT_THAT(values(table, "flow_L_min", 3), ElementsAre(1.0 / 3.0, NanSensitiveDoubleEq(none), 2.5));
  EXPECT_THAT(values(table, "status", 3), ElementsAre(0, 5, 4));
}

TEST(Hdf5Writer, WritesADatasetAColumnWithItsUnit) {
  const TemporaryFile file("small.h5", text_of(small_table(TableFormat::hdf5)));
  const auto table = open_hdf5_table(file.path());
  expect_small_rows(*table);
  std::map<std::string, std::string> units;
  for (const FileColumn& column : table->columns()) units[column.name] = column.unit;
  EXPECT_EQ(units["time_s"], "s");
  EXPECT_EQ(units["flow_L_min"], "L/min");
}

TEST(Hdf5Writer, ReportsAFullDiskInTheOutputsWords) {
  OutputInMemory output;
  output.places.limit = 100'000;
  std::string message;
  try {
    const auto writer = table_writer(TableFormat::hdf5, small_head(), output);
    const TableRows rows{{std::vector<double>(10'000, 1.0), std::vector<double>(10'000, 2.0)},
                         std::vector<std::uint32_t>(10'000)};
    for (int k = 0; k < 10; ++k) writer->write(rows);
    writer->finish();
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "the disk is full");
  EXPECT_NO_THROW((void)small_table(TableFormat::hdf5));  // the library goes on
}

TEST(MatWriter, WritesAVariableAColumnWithUnitsAndNames) {
  const Bytes bytes = small_table(TableFormat::mat);
  const std::string begun(bytes.begin(), bytes.begin() + 128);
  EXPECT_EQ(begun.substr(0, 29), "MATLAB 5.0 MAT-file, valve: A");
  EXPECT_EQ(begun.substr(124), std::string("\0\1IM", 4));
  // The first variable: a matrix of 80 bytes, of class 6 (double), 3 by 1, "time_s", 24 bytes of doubles.
  EXPECT_THAT(Bytes(bytes.begin() + 128, bytes.begin() + 128 + 64),
              ElementsAre(14, 0, 0, 0, 80, 0, 0, 0, 6, 0, 0, 0, 8, 0, 0, 0, 6, 0, 0, 0, 0, 0, 0, 0, 5, 0, 0, 0, 8, 0, 0,
                          0, 3, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 6, 0, 0, 0, 't', 'i', 'm', 'e', '_', 's', 0, 0, 9, 0,
                          0, 0, 24, 0, 0, 0));
  const TemporaryFile file("small.mat", text_of(bytes));
  const auto small = open_mat_table(file.path());
  small->look();
  expect_small_rows(*small);
  mat_t* const mat = Mat_Open(file.path().c_str(), MAT_ACC_RDONLY);
  ASSERT_NE(mat, nullptr);
  matvar_t* const units = Mat_VarRead(mat, "run_units");
  matvar_t* const names = Mat_VarRead(mat, "status_names");
  ASSERT_TRUE(units != nullptr && names != nullptr);
  const matvar_t* const flow = Mat_VarGetStructFieldByName(units, "flow_L_min", 0);
  ASSERT_NE(flow, nullptr);
  EXPECT_EQ(std::string(static_cast<const char*>(flow->data), flow->nbytes), "L/min");
  EXPECT_THAT(std::vector<std::size_t>(names->dims, names->dims + 2), ElementsAre(3U, 6U));
  EXPECT_EQ(std::string(static_cast<const char*>(names->data), names->nbytes), "c hl eo ls de  d  ");  // by columns
  Mat_VarFree(units);
  Mat_VarFree(names);
  Mat_Close(mat);
}

TEST(MatWriter, BringsStripsOfRowsTogether) {
  OutputInMemory output;
  const auto writer = table_writer(TableFormat::mat, small_head(), output);
  TableRows rows{{std::vector<double>(30'001), std::vector<double>(30'001)}, std::vector<std::uint32_t>(30'001)};
  for (std::size_t block = 0; block < 5; ++block) {
    for (std::size_t k = 0; k < rows.count(); ++k) {
      const std::size_t row = block * rows.count() + k;
      rows.numbers[0][k] = static_cast<double>(row), rows.numbers[1][k] = -static_cast<double>(row);
      rows.flags[k] = static_cast<std::uint32_t>(row);
    }
    writer->write(rows);
  }
  writer->finish();
  const TemporaryFile file("strips.mat", text_of(output.bytes()));
  const auto table = open_mat_table(file.path());
  table->look();
  const std::size_t count = 5 * rows.count();
  const auto times = values(*table, "time_s", count), flows = values(*table, "flow_L_min", count),
             words = values(*table, "status", count);
  for (std::size_t k = 0; k < count; ++k) {
    ASSERT_EQ(times[k], static_cast<double>(k));
    ASSERT_EQ(flows[k], -static_cast<double>(k));
    ASSERT_EQ(words[k], static_cast<double>(k));
  }
}

}  // namespace
}  // namespace spoolflow::recording

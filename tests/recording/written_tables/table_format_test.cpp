#include "spoolflow/recording/written_tables/table_format.hpp"

#include <gtest/gtest.h>

namespace spoolflow::recording {
namespace {

TEST(WrittenTableFormat, FollowsTheSuffixInCapitalsToo) {
  EXPECT_EQ(table_format_of("a/b.parquet"), TableFormat::parquet);
  EXPECT_EQ(table_format_of("b.H5"), TableFormat::hdf5);
  EXPECT_EQ(table_format_of("b.h5"), TableFormat::hdf5);
  EXPECT_EQ(table_format_of("b.hdf5"), TableFormat::hdf5);
  EXPECT_EQ(table_format_of("b.mat"), TableFormat::mat);
  for (const char* name : {"-", "b", "b.csv", "b.txt", "/dev/null", "b.mat.part", ".mat"})
    EXPECT_EQ(table_format_of(name), TableFormat::csv) << name;
}

TEST(WrittenTableFormat, WritesNoTextUnderANameThatPromisesOtherwise) {
  for (const char* other : {"b.xlsx", "b.json", "b.zip", "b.pq", "b.csv.gz", "b.mcap"})
    EXPECT_THROW((void)table_format_of(other), std::invalid_argument) << other;
  EXPECT_THROW((void)table_format_of("b.TDMS"), std::invalid_argument);
}

}  // namespace
}  // namespace spoolflow::recording

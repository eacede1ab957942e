#include "spoolflow/recording/text/table_search.hpp"
/// Text whose table stands below other lines, or whose names are written in ways of their own.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/reader.hpp"
#include "tests/recording/column_of.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const ReadOptions three_channels{{}, {Channel::time, Channel::current, Channel::position}, {}, {}};

Recording read_three(std::string_view content, const ReadOptions& options = three_channels) {
  const TemporaryFile file("run.csv", content);
  return read_recording(file.path(), options);
}

void expect_three_samples(const std::string& text) {
  const Recording run = read_three(text);
  ASSERT_EQ(run.size(), 3u) << text;
  EXPECT_NEAR(run[Channel::time][2], 0.002, 1e-12) << text;
  EXPECT_NEAR(run[Channel::current][2], 1.5, 1e-12) << text;
  EXPECT_NEAR(run[Channel::position][2], 0.0015, 1e-12) << text;
}

TEST(TableSearch, FindsTheTableBelowLinesOfSettings) {
  const std::string rows = "0,1.25,0.5\n0.001,1.5,1\n0.002,1.5,1.5\n";
  for (const std::string above : {
           "Rig: 3\nDate: 2025-03-04\nOperator: A. Meyer, night shift\n\n",
           "Sample rate,1000\nRange,5\nCoupling,1\nGain,2\nOffset,0\n",
           "Channels: time, current, position\nRate,1000,Hz\nStart,10:15:30,UTC\n",
           "Channel 1,I_coil,A\nChannel 2,LVDT,mm\nChannel 3,T oil,C\n\n",
           "[Setup]\nname=valve 7\nlimits=0,1,2\n\n[Data]\n",
           "Channels,3,of,8\n1,2,3,4\n\n",
           "sep=,\nRig,3\n",
           "\xEF\xBB\xBFRig 3; bench 2\n",
           "# Rig 3, cold oil, morning\n",
       })
    expect_three_samples(above + "time_s,current_A,position_mm\n" + rows);
}

TEST(TableSearch, ReadsTheSettingsOfAFileWithAsManyCellsAsItsTable) {
  const Recording run = read_three("Date,2025-03-04\nRate,1000\nRange,5\nGain,2\ntime_s,position_mm\n0,1\n0.001,1.5\n",
                                   {{}, {Channel::time, Channel::position}, {}, {}});
  EXPECT_THAT(std::vector<double>(run[Channel::position].begin(), run[Channel::position].end()),
              ElementsAre(0.001, 0.0015));
}

TEST(TableSearch, ReadsNamesAsSpreadsheetsAndOtherProgramsWriteThem) {
  for (const std::string text : {
           "# time_s,current_A,position_mm\n0,1.25,0.5\n0.001,1.5,1\n0.002,1.5,1.5\n",
           "# time_s current_A position_mm\n0.0e+00 1.25 0.5\n1.0e-03 1.5 1\n2.0e-03 1.5 1.5\n",
           "#time\tcurrent\tposition\n#s\tA\tmm\n0\t1.25\t0.5\n0.001\t1.5\t1\n0.002\t1.5\t1.5\n",
           "\"time\n[s]\",\"current\r\n[A]\",position [mm]\r\n0,1.25,0.5\n0.001,1.5,1\n0.002,1.5,1.5\n",
           "% rig 3\n% time_s,current_A,position_mm\n0,1.25,0.5\n0.001,1.5,1\n0.002,1.5,1.5\n",
           "time,current,position\n(s),(A),(mm)\n\n0,1.25,0.5\n0.001,1.5,1\n0.002,1.5,1.5\n",
           "time;current;position;remark\ns;A;mm\n0;1,25;0,5;\n0,001;1,5;1;\n0,002;1,5;1,5;peak\n",
           ",time_s,current_A,position_mm\n0,0,1.25,0.5\n1,0.001,1.5,1\n2,0.002,1.5,1.5\n",
           "time,current,position\n1000 Hz,1000 Hz,1000 Hz\ns,A,mm\n0,1.25,0.5\n0.001,1.5,1\n0.002,1.5,1.5\n",
           "Model,MSO56\nVertical Units,A,mm\nVertical Offset,0,0\n,,\nLabel,coil,spool\n"
           "time_s,current,position\n0,1.25,0.5\n0.001,1.5,1\n0.002,1.5,1.5\n",
           "time_s;current;position\nunit;A;mm\n0;1.25;0.5\n0.001;1.5;1\n0.002;1.5;1.5\n",
           "Unnamed: 0,time_s,current_A,position_mm\n0,0,1.25,0.5\n1,0.001,1.5,1\n2,0.002,1.5,1.5\n",
           "\xEF\xBB\xBF\"sep=;\"\n\"time_s\";\"current_A\";\"position_mm\"\n0;1,25;0,5\n0,001;1,5;1\n0,002;1,5;1,5\n",
       })
    expect_three_samples(text);
}

TEST(TableSearch, BeginsAtTheFirstHeaderThoughHeadersOrRubbishStandAmongTheRows) {
  for (const std::string_view among : {"time_s,current_A,position_mm", "rubbish", "what,is,this"}) {
    const std::vector<std::string_view> lines{"time_s,current_A,position_mm",
                                              "0,1.25,0.5",
                                              "0.001,1.5,1",
                                              among,
                                              "0.002,1.5,1.5",
                                              "0.003,1.5,1.5",
                                              "0.004,1.5,1.5"};
    const auto found = find_table(lines, {});
    ASSERT_TRUE(found) << among;
    EXPECT_EQ(found->samples, 1U) << among;
    EXPECT_EQ(found->header, std::optional<std::size_t>(0)) << among;
  }
}

TEST(TableSearch, NamesAColumnWithoutANameByItsNumber) {
  EXPECT_THAT(column_of("run.csv", ",time_s,\"\",current_A\n7,0,2,1\n8,1,3,1\n", "column 1"), ElementsAre(7, 8));
  EXPECT_THAT(column_of("run.csv", ",time_s,\"\",current_A\n7,0,2,1\n8,1,3,1\n", "column 3"), ElementsAre(2, 3));
}

TEST(TableSearch, TakesNumbersForNamesOfColumnsWhereTheFirstIsText) {
  EXPECT_THAT(column_of("run.csv", "x-axis,1,2\nsecond,Volt,Volt\n0,2,3\n1,4,5\n", "2"), ElementsAre(3, 5));
  EXPECT_THAT(column_of("run.csv", "x-axis,1,2\n0,2,3\n1,4,5\n", "1"), ElementsAre(2, 4));
}

TEST(TableSearch, TakesNamesThatBeginWithDigitsWhereNoOthersStandAbove) {
  EXPECT_THAT(column_of("run.csv", "Rig 3\n1: time;2: current\ns;A\n0;2\n1;4\n", "2: current"), ElementsAre(2, 4));
}

TEST(TableSearch, LeavesRowsWithoutNumbersBelowTheHeaderToTheReader) {
  EXPECT_THAT(refusal([] { (void)read_three("time_s,current_A,position_mm\n,,init\n0,1,1\n0.001,1,1\n"); }),
              HasSubstr("line 2, column 'position_mm': 'init' is not a number"));
}

TEST(TableSearch, SaysWhereAHeaderIsMissing) {
  EXPECT_THAT(refusal([] { (void)read_three("Rig 3\n\n0,1,1\n0.001,1,1\n"); }),
              AllOf(HasSubstr("line 3: has no header"), HasSubstr("insert a line there that names the columns")));
}

}  // namespace
}  // namespace spoolflow::recording

/// Text in which channels have times of their own, or state them above: exports of TwinCAT Scope, of LabVIEW
/// and of Rigol oscilloscopes.
#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/reader.hpp"
#include "tests/recording/column_of.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

/// With a comma in settings, as such programs on German machines write there, and `point` in the samples.
std::string scope_export(const std::string& rows) {
  return "Name\tYT Scope\nFile\tbench.csv\nStarttime of export\t1332\tTuesday, 4. March\t10:12:13.456\n"
         "Endtime of export\t1333\tTuesday\t10:12:13.755\n\n\nName\tI_coil\tName\txSpool\n"
         "SymbolComment\t\tSymbolComment\t\nSampleTime[ms]\t0,5\tSampleTime[ms]\t1\nOffset\t0\tOffset\t7\n"
         "Unit\tA (Current)\tUnit\tmm\nUnit ScaleFactor\t1\tUnit ScaleFactor\t1\n\n" +
         rows;
}

ChannelMap coil_and_spool() {
  ChannelMap out;
  out.sources.emplace(Channel::current, ChannelSource{"I_coil", "A", 1, 0, {}});
  out.sources.emplace(Channel::position, ChannelSource{"xSpool", "", 1, 0, {}});
  return out;
}

Recording read_pair(const std::string& text, const std::string& name = "scope.csv") {
  const TemporaryFile file(name, text);
  return read_recording(file.path(), {coil_and_spool(), {Channel::time, Channel::current, Channel::position}, {}, {}});
}

TEST(PairedTable, ReadsAnExportOfTwinCatScopeWithEqualTimesAsOneTable) {
  for (const std::string rows : {"0\t1.0\t0\t0.5\n1\t1.25\t1\t0.75\n", "0\t1,0\t0\t0,5\n1\t1,25\t1\t0,75\nEOF\n"}) {
    const Recording run = read_pair(scope_export(rows));
    ASSERT_EQ(run.size(), 2u);
    EXPECT_NEAR(run[Channel::time][1], 0.001, 1e-12);
    EXPECT_NEAR(run[Channel::current][1], 1.25, 1e-12);
    EXPECT_NEAR(run[Channel::position][1], 0.75e-3, 1e-12);
  }
  EXPECT_THAT(column_of("scope.csv", scope_export("0\t1\t0\t5\n1\t2\t1\t7\n"), "time"), ElementsAre(0, 1));
}

TEST(PairedTable, BringsChannelsOfTwinCatScopeOntoTheTimeOfTheCurrent) {
  const Recording run = read_pair(scope_export("0\t1\t0\t0.5\n0.5\t2\t1\t1.5\n1\t3\t2\t2.5\n1.5\t4\n2\t5\n"));
  ASSERT_EQ(run.size(), 5u);
  EXPECT_NEAR(run[Channel::time][3], 0.0015, 1e-12);
  EXPECT_NEAR(run[Channel::current][3], 4, 1e-12);
  EXPECT_NEAR(run[Channel::position][3], 2e-3, 1e-12);
  EXPECT_THAT(run.resampled, HasSubstr("'xSpool' from 1000 Hz"));
}

Recording read_pair_by_name(const std::string& text) {
  const TemporaryFile file("run.csv", text);
  return read_recording(file.path(), {{}, {Channel::current, Channel::position}, {}, {}});
}

TEST(PairedTable, ACsvMayWriteTheTimesOfAChannelBesideIt) {
  const std::string rows = "\n0,1,0.002,0.5\n0.001,2,0.004,1.5\n0.002,3,,\n0.003,4,,\n0.004,5,,\n";
  for (const std::string names : {"time_s,current_A,position_time_s,position_mm",
                                  "time_s,current_A,time_s.1,position_mm", "time_s,current_A,time_s,position_mm"}) {
    const Recording run = read_pair_by_name(names + rows);
    ASSERT_EQ(run.size(), 5u) << names;
    EXPECT_TRUE(std::isnan(run[Channel::position][1])) << names;
    EXPECT_NEAR(run[Channel::position][2], 0.5e-3, 1e-12) << names;
    EXPECT_NEAR(run[Channel::position][3], 1e-3, 1e-12) << names;
  }
  const std::string behind = "time_s,position_mm,position_time_s,current_A\n0,0.5,0.001,1\n0.001,1.5,0.002,2\n";
  EXPECT_NEAR(read_pair_by_name(behind)[Channel::position][1], 0.5e-3, 1e-12);
}

TEST(PairedTable, ASecondTimeOfAnotherNameIsAColumnAsAnyOther) {
  EXPECT_THAT(column_of("run.csv", "time_s,timestamp_ms,current_A\n0,5,1\n1,6,2\n", "timestamp_ms"), ElementsAre(5, 6));
}

TEST(PairedTable, ReadsAnExportInWhichChannelsShareAColumnOfTimes) {
  const std::string text =
      "Name;Scope;\nFile;x.csv;\nStarttime of "
      "export;1;Monday;10:00\n\nName;I_coil;xSpool;Name;p\nUnit;A;mm;Unit;bar\n\n"
      "0;1;2;0;60\n1;1;3;5;61\n2;1;4\n";
  EXPECT_THAT(column_of("scope.csv", text, "xSpool"), ElementsAre(2, 3, 4));
  EXPECT_THAT(column_of("scope.csv", text, "p"), ElementsAre(60, 61));
  EXPECT_THAT(column_of("scope.csv", text, "time of p"), ElementsAre(0, 5));
}

TEST(PairedTable, RefusesShortRowsBelowManyNamesThatWouldFillTheMemory) {
  std::string names = "Name", first = "0";
  for (int k = 0; k < 20000; ++k) names += "\tc" + std::to_string(k), first += "\t1";
  std::string text = "Name\tScope\nStarttime of export\t1\n\n" + names + "\n\n" + first + "\n";
  for (int k = 1; k < 2000; ++k) text += std::to_string(k) + "\t1\n";
  EXPECT_THAT(refusal([&] { (void)column_of("scope.csv", text, "c0"); }), HasSubstr("200 times its size"));
}

TEST(PairedTable, RefusesNamesThatHoldTheSeparator) {
  const std::string text =
      "Name Scope\nFile x.csv\nStarttime of export 1 Monday 10:00\n\nName I coil Name xSpool\nUnit A Unit mm\n\n0 1 0 "
      "2\n";
  EXPECT_THAT(refusal([&] { (void)column_of("scope.csv", text, "xSpool"); }), HasSubstr("export it again with tab"));
}

TEST(PairedTable, SaysWhereAChannelOfItHoldsText) {
  EXPECT_THAT(refusal([] { (void)read_pair(scope_export("0\t1\t0\t0.5\n1\tfault\t1\t1.5\n")); }),
              HasSubstr("column 'I_coil': 'fault' in line 15 is not a number"));
}

std::string lvm(const std::string& columns, const std::string& more, const std::string& names_and_rows) {
  return "LabVIEW Measurement\t\nX_Columns\t" + columns +
         "\nDecimal_Separator\t,\n***End_of_Header***\t\n\t\nChannels\t2\t\t\t\n" + more +
         "***End_of_Header***\t\t\t\n" + names_and_rows;
}

TEST(PairedTable, ReadsALabViewFileWithAColumnOfTimesForEachChannel) {
  const std::string head = "Y_Unit_Label\tA\t\tmm\nX_Dimension\tTime\t\tTime\n";
  const std::string names = "X_Value\tI_coil\tX_Value\txSpool\tComment\n";
  const Recording same = read_pair(lvm("Multi", head, names + "0,0\t1,5\t0,0\t2,5\n0,001\t1,5\t0,001\t3,5\n"), "a.lvm");
  ASSERT_EQ(same.size(), 2u);
  EXPECT_NEAR(same[Channel::position][1], 3.5e-3, 1e-12);
  const Recording other = read_pair(
      lvm("Multi", head, names + "0,0\t1,5\t0,0\t2,5\n0,001\t1,5\t0,002\t3,5\n0,002\t1,5\t0,004\t4,5\n"), "b.lvm");
  ASSERT_EQ(other.size(), 3u);
  EXPECT_NEAR(other[Channel::position][1], 3e-3, 1e-12);
}

TEST(PairedTable, ReadsTimesOfALabViewFileThatStatesThemByTheirStep) {
  const std::string steps = "Y_Unit_Label\tA\tmm\t\t\nX0\t0,5\t0,5\nDelta_X\t1,0E-3\t";
  const std::string rows = "X_Value\tcurrent\tposition\tComment\n\t1,25\t0,5\n\t1,5\t0,75\tpeak\n";
  EXPECT_THAT(column_of("run.lvm", lvm("No", steps + "1,0E-3\n", rows), "X_Value"), ElementsAre(0.5, 0.501));
  EXPECT_THAT(column_of("run.lvm", lvm("No", steps + "1,0E-3\n", rows), "position"), ElementsAre(0.5, 0.75));
  EXPECT_THAT(refusal([&] { (void)column_of("run.lvm", lvm("No", steps + "2,0E-3\n", rows), "position"); }),
              HasSubstr("save it with X_Columns One or Multi"));
  EXPECT_THAT(refusal([&] {
                (void)column_of("run.lvm", lvm("No", steps + "1,0E-3\n", rows) + "\n\nChannels\t2\nSamples\t3\t3\n",
                                "position");
              }),
              HasSubstr("line 16: another block of samples begins"));
}

TEST(PairedTable, CountsTheSamplesOfARigolOscilloscopeFromTheTimeThatItStates) {
  const std::string rows = "0,1.25e+00,5.0e-01,\n1,1.50e+00,7.5e-01,\n4,1.75e+00,8.0e-01,\n";
  for (const std::string end : {"", ","}) {
    const std::string text = "X,CH1,CH2,Start,Increment" + end + "\nSequence,Volt,Volt,-6.0e-03,1.0e-03\n" + rows;
    EXPECT_THAT(column_of("scope.csv", text, "time"),
                ElementsAre(DoubleNear(-6e-3, 1e-15), DoubleNear(-5e-3, 1e-15), DoubleNear(-2e-3, 1e-15)));
    EXPECT_THAT(column_of("scope.csv", text, "CH2"), ElementsAre(0.5, 0.75, 0.8));
  }
  for (const std::string times : {"-6.0e-03,0", "-6.0e-03", ",1e-3"}) {
    EXPECT_THAT(refusal([&] {
                  (void)column_of("scope.csv", "X,CH1,CH2,Start,Increment\nSequence,Volt,Volt," + times + "\n" + rows,
                                  "CH2");
                }),
                HasSubstr("line 2: states no first time and no time step > 0"));
  }
}

}  // namespace
}  // namespace spoolflow::recording

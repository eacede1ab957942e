#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/reader.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

const ReadOptions position_over_time{{}, {Channel::time, Channel::position}, {}, {}};

Recording read_csv(std::string_view content, const ReadOptions& options = position_over_time) {
  const TemporaryFile file("run.csv", content);
  return read_recording(file.path(), options);
}

std::string refused_csv(std::string_view content, const ReadOptions& options = position_over_time) {
  return refusal([&] { (void)read_csv(content, options); });
}

std::vector<double> column(const Recording& recording, Channel channel) {
  const auto values = recording[channel];
  return {values.begin(), values.end()};
}

TEST(CsvReading, TurnsHeadersOfChannelAndUnitIntoSi) {
  const Recording run = read_csv("time_s,position_mm\n0.000,1.0\n0.001,-2.5\n");
  EXPECT_THAT(column(run, Channel::time), ElementsAre(0.0, 0.001));
  EXPECT_THAT(column(run, Channel::position), ElementsAre(0.001, -0.0025));
}

TEST(CsvReading, ReadsTheSameNumbersFromEveryDialect) {
  const Recording plain = read_csv("time_s,current_A,position_mm\n0,0.5,1.25\n0.001,0.6,1.5\n");
  for (const char* dialect : {
           "time_s;current_A;position_mm\n0;0.5;1.25\n0.001;0.6;1.5\n",
           "time_s;current_A;position_mm\n0;0,5;1,25\n0,001;0,6;1,5\n",
           "time_s\tcurrent_A\tposition_mm\r\n0\t0,5\t1,25\r\n0,001\t0,6\t1,5\r\n",
           "\xEF\xBB\xBFtime_s,current_A,position_mm\r\n0,0.5,1.25\r\n0.001,0.6,1.5",
           "sep=;\ntime_s;current_A;position_mm\n0;0,5;1,25\n0,001;0,6;1,5\n",
           "\"time_s\",\"current_A\",\"position_mm\"\n\"0\",\"0.5\",\"1.25\"\n\"0.001\",\"0.6\",\"1.5\"\n",
           "\"time_s\",\"current_A\",\"position_mm\"\n\"0\",\"0,5\",\"1,25\"\n\"0,001\",\"0,6\",\"1,5\"\n",
           "# rig 3\ntime_s,current_A,position_mm\n# warm oil\n0,0.5,1.25\n\n0.001,0.6,1.5\n\n\n",
           "time_s,current_A,position_mm,\n0,0.5,1.25,\n0.001,0.6,1.5,\n",
           "time_s,current_A,position_mm\n0,0.5,1.25,\n0.001,0.6,1.5,\n",
           "time,current,position\ns,A,mm\n0,0.5,1.25\n0.001,0.6,1.5\n",
           "time;current;position\n[s];[A];[mm]\n0;0,5;1,25\n0,001;0,6;1,5\n",
           "time [s], current [A], position (mm)\n 0, 5e-1, 1.25\n 1.0E-3, 6.0e-01, +1.5\n",
           "note,time_s,current_A,position_mm\n\"a, b\",0,0.5,1.25\nc,0.001,0.6,1.5\n",
       }) {
    const Recording run = read_csv(dialect);
    EXPECT_EQ(column(run, Channel::time), column(plain, Channel::time)) << dialect;
    EXPECT_EQ(column(run, Channel::position), column(plain, Channel::position)) << dialect;
  }
}

TEST(CsvReading, ReadsUtf16OfAnySizeToItsEnd) {
  std::string text = "time_s,position_mm\n", wide = "\xFF\xFE";
  constexpr int rows = 40000;  // more than one block
  for (int k = 0; k < rows; ++k) text += fmt::format("{:.3f},{}\n", 1e-3 * k, k % 7);
  for (const char c : text) wide += {c, '\0'};
  const Recording run = read_csv(wide);
  ASSERT_EQ(column(run, Channel::time).size(), static_cast<std::size_t>(rows));
  EXPECT_DOUBLE_EQ(column(run, Channel::time).back(), 1e-3 * (rows - 1));
  EXPECT_DOUBLE_EQ(column(run, Channel::position).back(), 1e-3 * ((rows - 1) % 7));
}

TEST(CsvReading, TakesAnEmptyCellForAMissingSampleAndCountsIt) {
  const TemporaryFile file("run.csv", "time_s,position_mm\n0,1\n0.001,\n0.002,3\n0.002,4\n");
  const auto reader = open_reader(file.path(), position_over_time);
  SampleBlock block;
  ASSERT_TRUE(reader->next(block));
  ASSERT_EQ(block.rows, 4u);
  EXPECT_TRUE(std::isnan(block.columns[static_cast<std::size_t>(Channel::position)][1]));
  EXPECT_FALSE(reader->next(block));
  EXPECT_EQ(reader->notes().rows, 4u);
  EXPECT_EQ(reader->notes().missing_values(), 1u);
  EXPECT_EQ(reader->notes().duplicate_times, 1u);
}

TEST(CsvReading, FindsCellsWhereverTheyBeginInALine) {
  for (std::size_t width = 0; width < 200; ++width) {
    const std::string note(width, 'n');
    const Recording run = read_csv("note,time_s,position_mm,end\n" + note + ",0.001,-1.25," + note + "\n" + note +
                                   ",1785.9990,-12.3456785,\n");
    EXPECT_THAT(column(run, Channel::time), ElementsAre(0.001, 1785.999)) << width;
    EXPECT_EQ(column(run, Channel::position).front(), -0.00125) << width;
    EXPECT_THAT(refused_csv("note,time_s,position_mm,end\n" + note + ",0,1,2,3\n"), HasSubstr("cells")) << width;
    EXPECT_THAT(refused_csv("note,time_s,position_mm,end\n" + note + ",0,1\n"), HasSubstr("cells")) << width;
  }
}

TEST(CsvReading, LeavesTextInColumnsThatNobodyAskedFor) {
  EXPECT_EQ(read_csv("time_s,status,position_mm\n0,fully_open|at_rest,1\n1e-3,,2\n").size(), 2u);
}

TEST(CsvReading, ReadsNumbersWithUnitsAndPrefixesBehindThemInTheUnitOfTheirColumn) {
  const ReadOptions all{{}, {Channel::time, Channel::current, Channel::position}, {}, {}};
  for (const std::string text : {
           "time_s,current_A,position_mm\n0,25.1m,1.5\n0.001,0.026,1.6\n",
           "time_s,current_A,position_mm\n0 s,25.1 mA,1.5 mm\n1 ms,26mA,1600 um\n",
           "time;current;position\n0 s;25,1 mA;1,5 mm\n0,001 s;0,026 A;0,0016 m\n",
           "time_s,current [A],position [mm]\n0,25100u,1.5\n1m,2.6e-5k,1.6mm\n",
           "time_ms,current_mA,position_um\n0,0.0251 A,1.5 mm\n1,26,1600\n",
       }) {
    const Recording run = read_csv(text, all);
    EXPECT_NEAR(run[Channel::time][1], 0.001, 1e-12) << text;
    EXPECT_NEAR(run[Channel::current][0], 0.0251, 1e-12) << text;
    EXPECT_NEAR(run[Channel::current][1], 0.026, 1e-12) << text;
    EXPECT_NEAR(run[Channel::position][0], 0.0015, 1e-12) << text;
    EXPECT_NEAR(run[Channel::position][1], 0.0016, 1e-12) << text;
  }
  const ReadOptions oil{{}, {Channel::time, Channel::oil_temperature}, {}, {}};
  for (const char* cells : {"50 C", "50 \xC2\xB0\x43", "323.15K", "122 degF"}) {
    const Recording run = read_csv("time_s,oil_temperature_C\n0," + std::string(cells) + "\n", oil);
    EXPECT_NEAR(run[Channel::oil_temperature][0], 323.15, 1e-9) << cells;
  }
}

TEST(CsvReading, RefusesSuffixesOfWhichTheColumnDoesNotSayWhatTheyMean) {
  EXPECT_THAT(
      refused_csv("time_s,position_mm\n0,1\n1,3.2m\n"),
      HasSubstr("line 3, column 'position_mm': '3.2m' may be in milli or in metres, where the column is in mm"));
  ReadOptions current{{}, {Channel::time, Channel::current}, {}, {}};
  EXPECT_THAT(refused_csv("time_s,current_mA\n0,4.7k\n", current),
              HasSubstr("'4.7k' has a prefix, and the column is in mA"));
  EXPECT_THAT(refused_csv("time_s,current_A\n0,3 bar\n", current),
              HasSubstr("'3 bar' states a unit, but the column is in A"));
  current.channels.sources.emplace(Channel::current, ChannelSource{"I", "A", 1, 0, {}});
  EXPECT_THAT(refused_csv("time_s,I\n0,25.1m\n", current),
              AllOf(HasSubstr("line 2, column 'I': '25.1m' has a prefix"), HasSubstr("states no unit for the column"),
                    HasSubstr("such as current_A or I [A]")));
  EXPECT_THAT(refused_csv("time_s,I\n0,25 mA\n", current), HasSubstr("is mapped with unit A, but"));
}

TEST(CsvReading, SaysWhereANumberIsNone) {
  const std::string text = refused_csv("time_s,position_mm\n0,1\n0.001,abc\n");
  EXPECT_THAT(text, HasSubstr("run.csv, line 3, column 'position_mm': 'abc' is not a number"));
  EXPECT_THAT(refused_csv("time_s,position_mm\n0,1\n0.001,-inf\n"), HasSubstr("'-inf' is not finite"));
  EXPECT_THAT(refused_csv("time_s,position_mm\n0,1\n0.001,1e999\n"), HasSubstr("'1e999' is larger than"));
  EXPECT_THAT(refused_csv("time_s,position_mm\n0,1\n,2\n"),
              HasSubstr("line 3, column 'time_s': the time stamp is missing"));
}

TEST(CsvReading, TakesTextInSixteenBitsOfEitherOrder) {
  const std::string text = "time_s,position_mm,\xC3\x96l\n0,1,\xF0\x9F\x98\x80\n0.001,1.5,x\n";
  // Its units: ASCII as it is, U+00D6, and U+1F600 as the pair D83D DE00.
  const std::u16string units = u"\uFEFFtime_s,position_mm,\u00D6l\n0,1,\U0001F600\n0.001,1.5,x\n";
  const Recording plain = read_csv(text);
  for (const bool high_first : {false, true}) {
    std::string bytes;
    for (const char16_t unit : units) {
      const char high = static_cast<char>(unit >> 8), low = static_cast<char>(unit & 0xFF);
      bytes += high_first ? high : low;
      bytes += high_first ? low : high;
    }
    const Recording run = read_csv(bytes);
    EXPECT_EQ(column(run, Channel::time), column(plain, Channel::time)) << high_first;
    EXPECT_EQ(column(run, Channel::position), column(plain, Channel::position)) << high_first;
  }
}

TEST(CsvReading, CountsTimesOfTheClockFromTheFirst) {
  for (const std::string text : {
           "time,position_mm\n2026-11-22T10:59:59.900,1\n2026-11-22T11:00:00.150,2\n2026-11-22T11:00:00.400,3\n",
           "time,position_mm\n2026-12-31 23:59:59.9Z,1\n2027-01-01 00:00:00.15Z,2\n2027-01-01 01:00:00.4+01:00,3\n",
           "time;position_mm\n22.11.2026 10:59:59,900;1\n22.11.2026 11:00:00,150;2\n22.11.2026 11:00:00,400;3\n",
           "time,position_mm\n10:59:59.900,1\n11:00:00.150,2\n11:00:00.400,3\n",
       }) {
    const Recording run = read_csv(text);
    ASSERT_EQ(run.size(), 3u) << text;
    EXPECT_NEAR(run[Channel::time][0], 0, 1e-9) << text;
    EXPECT_NEAR(run[Channel::time][1], 0.25, 1e-9) << text;
    EXPECT_NEAR(run[Channel::time][2], 0.5, 1e-9) << text;
  }
  EXPECT_THAT(refused_csv("time_s,position_mm\n0,1\n2026-13-41T10:00:00,1\n"), HasSubstr("is not a number"));
}

TEST(CsvReading, CountsATimeOfDayOnPastMidnight) {
  const Recording run = read_csv(
      "Date,time,position_mm\n2025-03-04,23:59:59.700,1\n2025-03-04,23:59:59.950,2\n"
      "2025-03-05,00:00:00.200,3\n2025-03-05,00:00:00.450,4\n");
  ASSERT_EQ(run.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(run[Channel::time][k], 0.25 * static_cast<double>(k), 1e-9);
  EXPECT_THAT(refused_csv("time,position_mm\n10:00:01,1\n10:00:00,2\n"), HasSubstr("time runs backwards"));
}

TEST(CsvReading, ReadsAmericanDatesWithAMAndPMOverNoonAndMidnight) {
  for (const std::string text : {
           "time,position_mm\n3/4/2025 11:59:59.900 AM,1\n3/4/2025 12:00:00.150 PM,2\n3/4/2025 12:00:00.400 PM,3\n",
           "time,position_mm\n12/31/2025 11:59:59.900 PM,1\n1/1/2026 12:00:00.150 AM,2\n1/1/2026 12:00:00.400 AM,3\n",
           "time,position_mm\n9:59:59.900 am,1\n10:00:00.150 am,2\n10:00:00.400 am,3\n",
       }) {
    const Recording run = read_csv(text);
    ASSERT_EQ(run.size(), 3u) << text;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(run[Channel::time][k], 0.25 * static_cast<double>(k), 1e-9) << text;
  }
  // Without AM or PM nothing separates day and month.
  EXPECT_THAT(refused_csv("time_s,position_mm\n0,1\n3/4/2025 11:59:59,1\n"),
              HasSubstr("'3/4/2025 11:59:59' is not a number"));
  EXPECT_THAT(refused_csv("time_s,position_mm\n0,1\n13/4/2025 11:59:59 AM,1\n"), HasSubstr("is not a number"));
}

TEST(CsvReading, FindsColumnsOfAFileInWindows1252ByTheirNamesInUtf8) {
  ReadOptions options{{}, {Channel::time, Channel::oil_temperature}, {}, {}};
  options.channels.sources.emplace(Channel::oil_temperature,
                                   ChannelSource{"\xC3\x96ltemp. [\xC2\xB0\x43]", "C", 1, 0, {}});
  const Recording run = read_csv("time_s;\xD6ltemp. [\xB0\x43]\n0;50,5\n0,001;51,5\n", options);
  EXPECT_NEAR(run[Channel::oil_temperature][1], 273.15 + 51.5, 1e-9);
}

TEST(CsvReading, ReadsLabViewMeasurementFilesBelowTheirSettings) {
  for (const std::string point : {".", ","}) {
    std::string text = "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t" + point +
                       "\n***End_of_Header***\t\n\t\nChannels\t2\t\t\t\nY_Unit_Label\tA\tmm\t\t\n"
                       "X_Dimension\tTime\tTime\t\t\n***End_of_Header***\t\t\t\t\nX_Value\tcurrent\tposition\tComment\n"
                       "0_000\t1_25\t0_5\t\n0_001\t1_50\t0_75\t\n";
    for (char& c : text) c = c == '_' && text[static_cast<std::size_t>(&c - text.data()) - 1] < ':' ? point[0] : c;
    ReadOptions options{{}, {Channel::time, Channel::current, Channel::position}, {}, {}};
    options.channels.sources.emplace(Channel::time, ChannelSource{"X_Value", "s", 1, 0, {}});
    const Recording run = read_csv(text, options);
    EXPECT_THAT(column(run, Channel::time), ElementsAre(0.0, 0.001)) << point;
    EXPECT_THAT(column(run, Channel::current), ElementsAre(1.25, 1.5)) << point;
    EXPECT_THAT(column(run, Channel::position), ElementsAre(0.0005, 0.00075)) << point;
  }
}

TEST(CsvReading, FindsTheHeaderBelowLinesOfTitle) {
  const Recording plain = read_csv("time_s,position_mm\n0,1\n0.001,1.5\n");
  for (const std::string text : {
           "Measurement 12, rig 3, morning\n\ntime_s,position_mm\n0,1\n0.001,1.5\n",
           "Operator: A. Meyer\nDate;12.11.2026;at;10:15;;\n\ntime;position\ns;mm\n0;1\n0,001;1,5\n",
           "Rig 3\ttime 10:15\t\tx\ntime_s\tposition_mm\n0\t1\n0.001\t1.5\n",
       }) {
    const Recording run = read_csv(text);
    EXPECT_EQ(column(run, Channel::time), column(plain, Channel::time)) << text;
    EXPECT_EQ(column(run, Channel::position), column(plain, Channel::position)) << text;
  }
}

TEST(CsvReading, TakesTheUsualWordsForNoNumberAsMissing) {
  for (const char* word : {"NaN", "nan", "NULL", "null", "-", "--", "n/a", "#N/A", "1.#QNAN"}) {
    const Recording run = read_csv("time_s,position_mm\n0,1\n0.001," + std::string(word) + "\n0.002,3\n");
    ASSERT_EQ(run.size(), 3u) << word;
    EXPECT_TRUE(std::isnan(run[Channel::position][1])) << word;
  }
}

TEST(CsvReading, SaysWhereTimeRunsBackwards) {
  EXPECT_THAT(refused_csv("time_s,position_mm\n0,1\n0.002,1\n0.001,1\n"),
              HasSubstr("line 4, column 'time_s': time runs backwards, from 0.002 to 0.001 s"));
}

TEST(CsvReading, RefusesRowsThatAreTooShortOrTooLong) {
  EXPECT_THAT(refused_csv("time_s,position_mm\n0,1\n0.001\n"), HasSubstr("line 3: has 1 cells, the header has 2"));
  EXPECT_THAT(refused_csv("time_s,position_mm\n0,1\n0.001,1,2\n"), HasSubstr("line 3: has 3 cells, the header has 2"));
}

TEST(CsvReading, RefusesFilesWithoutHeaderOrSamples) {
  EXPECT_THAT(refused_csv("time_s,position_mm\n"), HasSubstr("has a header but no samples"));
  EXPECT_THAT(refused_csv("\n\n"), HasSubstr("holds no header line"));
  EXPECT_THAT(refused_csv("0.0,1.0\n0.1,1.1\n"), HasSubstr("insert a first line that names the columns"));
  EXPECT_THAT(refused_csv(std::string("time_s,") + std::string(300 << 10, 'x') + ",current_A\n0,1,2\n"),
              HasSubstr("header goes on for more than 256 KiB"));
  EXPECT_THAT(refused_csv("time_s,current_A\ns," + std::string(300 << 10, 'x') + "\n0,1\n"),
              HasSubstr("header goes on for more than 256 KiB"));
  const TemporaryFile empty("empty.csv");
  empty.write("");
  EXPECT_THAT(refusal([&] { (void)read_recording(empty.path(), position_over_time); }), HasSubstr("is empty"));
  EXPECT_THAT(refusal([&] { (void)read_recording(empty.folder() / "no.csv", position_over_time); }),
              HasSubstr("no.csv: cannot be opened: No such file or directory"));
  EXPECT_THAT(refusal([&] { (void)read_recording(empty.folder(), position_over_time); }), HasSubstr("is a folder"));
}

TEST(CsvReading, NamesAMissingChannelWithTheColumnsThatAreThere) {
  const std::string text = refused_csv("time_s,flow_L_min\n0,1\n");
  EXPECT_THAT(text, HasSubstr("channel position is missing; the columns are time_s, flow_L_min"));
  EXPECT_THAT(refused_csv("time_s,position_furlong\n0,1\n"), HasSubstr("'furlong' is no known unit"));
}

TEST(CsvReading, DoesNotStumbleOverLatin1DegreeSigns) {
  const ReadOptions oil{{}, {Channel::oil_temperature}, {}, {}};
  for (const char* header : {"oil_temperature [\xB0"
                             "C]",
                             "oil_temperature [\xC2\xB0"
                             "C]",
                             "oil_temperature_\xB0"
                             "C"}) {
    const Recording run = read_csv(std::string("time_s;") + header + "\n0;50,0\n", oil);
    EXPECT_NEAR(run[Channel::oil_temperature][0], 323.15, 1e-9) << header;
  }
}

TEST(CsvReading, RefusesMarksThatGroupThousandsBesideNumbersWithout) {
  EXPECT_THAT(refused_csv("time_ms;position_um\n0;951\n1;996\n2;1.000\n"),
              AllOf(HasSubstr("column 'position_um': '1.000'"), HasSubstr("group thousands")));
  EXPECT_THAT(refused_csv("time_ms,position_um\n0,951\n1,996\n2,\"1,088\"\n"), HasSubstr("'1,088'"));
  EXPECT_THAT(refused_csv("time_ms;position_um\n998;951\n999;996\n1.000;997\n"),
              HasSubstr("column 'time_ms': '1.000'"));
}

TEST(CsvReading, TakesThreeDecimalsForDecimalsWhereNothingSpeaksForThousands) {
  EXPECT_DOUBLE_EQ(read_csv("time_ms;position_mm\n0;1,088\n1;1,100\n", position_over_time)[Channel::position][0],
                   1.088e-3);
  EXPECT_DOUBLE_EQ(read_csv("time_ms;position_mm\n0;0\n1;1.088\n2;1.1\n", position_over_time)[Channel::position][1],
                   1.088e-3);
  EXPECT_DOUBLE_EQ(
      read_csv("time_ms;position_mm\n0;1\n1;2\n2;2.125\n3;0.5\n", position_over_time)[Channel::position][2], 2.125e-3);
}

TEST(CsvReading, ReadsGroupedThousandsBesideADecimalSign) {
  const ReadOptions options{{}, {Channel::time, Channel::current, Channel::position}, {}, {}};
  for (const char* text : {"Time (ms);Current (mA);Position (um)\n998,00;1.000,00;-1.928,10\n1.000,00;999,50;0,00\n",
                           "time_ms,current_mA,position_um\n998,\"1,000.00\",\"-1,928.10\"\n\"1,000.0\",999.5,0\n"}) {
    const Recording run = read_csv(text, options);
    EXPECT_THAT(column(run, Channel::time), ElementsAre(0.998, 1.0)) << text;
    EXPECT_THAT(column(run, Channel::current), ElementsAre(1.0, 0.9995)) << text;
    EXPECT_THAT(column(run, Channel::position), ElementsAre(DoubleNear(-1.9281e-3, 1e-15), 0.0)) << text;
  }
  for (const char* mark : {"'", "\xE2\x80\x99", "\xE2\x80\xAF", "\xC2\xA0", "\xA0"}) {
    const Recording run = read_csv(fmt::format("time_ms;position_um\n0;1{0}234\n1{0}000;-1{0}234,5\n", mark));
    EXPECT_THAT(column(run, Channel::time), ElementsAre(0.0, 1.0)) << mark;
    EXPECT_THAT(column(run, Channel::position),
                ElementsAre(DoubleNear(1.234e-3, 1e-15), DoubleNear(-1.2345e-3, 1e-15)));
  }
  EXPECT_THAT(refused_csv("time_ms;position_um\n0;0,5\n1;1'23\n"), HasSubstr("'1'23' is not a number"));
  EXPECT_THAT(refused_csv("time_ms;position_um\n0;0,5\n1;0,5\n2;1,234.5\n"), HasSubstr("'1,234.5' is not a number"));
  EXPECT_THAT(refused_csv("time_ms;position_um\n0;0,5\n1;1.23,5\n"), HasSubstr("'1.23,5' is not a number"));
}

TEST(CsvReading, RefusesZeroBytesWhereverTheyStand) {
  std::string text = "time_s,position_mm,remark\n";
  for (int k = 0; k < 30000; ++k) text += std::to_string(0.001 * k) + ",0.5,nothing to say\n";
  for (const std::size_t at : {std::size_t{5000}, std::size_t{300000}, text.size() - 3}) {
    std::string damaged = text;
    damaged[at] = '\0';
    EXPECT_THAT(refused_csv(damaged), HasSubstr("it holds a zero byte at byte " + std::to_string(at + 1))) << at;
  }
}

}  // namespace
}  // namespace spoolflow::recording

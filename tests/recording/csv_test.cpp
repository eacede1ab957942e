#include <charconv>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/csv_writer.hpp"
#include "spoolflow/recording/decimal.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/recording/recording_error.hpp"
#include "temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Recording read_text(const std::string& text, ReadOptions options = {}) {
  const TemporaryFile file("recording.csv", text);
  return read_recording(file.path(), options);
}

void expect_refusal(const std::string& text, const std::vector<std::string>& parts, ReadOptions options = {}) {
  try {
    (void)read_text(text, std::move(options));
    ADD_FAILURE() << "was not refused: " << text;
  } catch (const RecordingError& error) {
    for (const std::string& part : parts) EXPECT_THAT(error.what(), HasSubstr(part));
  }
}

std::vector<double> column(const Recording& recording, Channel channel) {
  const auto values = recording[channel];
  return {values.begin(), values.end()};
}

TEST(Csv, ReadsEveryDialectToTheSameSI) {
  const std::vector<std::string> texts{
      "time_s,current_mA,position_mm\n0,100,0.5\n0.001,150,1.25\n",
      "\xef\xbb\xbftime_s;current_mA;position_mm\r\n0;100;0,5\r\n0,001;150;1,25\r\n",
      "\"time_s\"\t\"current_mA\"\t\"position_mm\"\n0\t100\t0.5\n0.001\t150\t1.25\n\n",
      "time_ms,current_A,position_um\n0,0.1,500\n1,0.15,1250",
      "time,current,position\ns,mA,mm\n0,100,0.5\n0.001,150,1.25\n",
      "time;current;position;\n[s];[mA];[mm];\n0; 100 ;0,5;\n1e-3;\"150\";1,25;\n",
  };
  for (const std::string& text : texts) {
    const Recording recording = read_text(text);
    EXPECT_THAT(column(recording, Channel::time), ElementsAre(0, 0.001)) << text;
    EXPECT_THAT(column(recording, Channel::current), ElementsAre(::testing::DoubleEq(0.1), ::testing::DoubleEq(0.15)))
        << text;
    EXPECT_THAT(column(recording, Channel::position),
                ElementsAre(::testing::DoubleEq(0.5e-3), ::testing::DoubleEq(1.25e-3)))
        << text;
  }
}

TEST(Csv, TakesAnEmptyCellForAMissingSampleAndTellsRepeatedTimes) {
  const TemporaryFile file("gaps.csv", "time_s,current_A\n0,1\n0.001,\n0.001,2\n");
  const auto reader = open_reader(file.path(), {});
  SampleBlock block;
  ASSERT_TRUE(reader->next(block));
  EXPECT_TRUE(std::isnan(block.columns[static_cast<std::size_t>(Channel::current)][1]));
  EXPECT_EQ(reader->notes().missing_values, 1U);
  EXPECT_EQ(reader->notes().duplicate_times, 1U);
}

TEST(Csv, SaysWhatIsWrongAndWhere) {
  expect_refusal("", {"is empty"});
  expect_refusal("time_s,current_A\n", {"no samples"});
  expect_refusal("time_s,current_A\n0,1\n0.1,abc\n", {"line 3", "current_A", "\"abc\"", "no number"});
  expect_refusal("time_s,current_A\n0,1\n0.1,NaN\n", {"line 3", "not finite"});
  expect_refusal("time_s,current_A\n0,-inf\n", {"line 2", "not finite"});
  expect_refusal("time_s,current_A\n0,1\n0.2,1\n0.1,1\n", {"line 4", "backwards", "0.2", "0.1"});
  expect_refusal("time_s,current_A\n0,1\n0.1\n", {"line 3", "1 columns", "2"});
  expect_refusal("time_s,current_A\n0,1\n0,1,1,5\n", {"line 3", "decimal comma"});
  expect_refusal("0,1\n0.1,2\n", {"line 1", "no column names"});
  expect_refusal("time_s,current_bar\n0,1\n", {"bar is a unit of pressure", "A, mA"});
  expect_refusal("time_s,current_A,current_mA\n0,1,1\n", {"both channel current"});
  ReadOptions needs_position;
  needs_position.required = {Channel::time, Channel::position};
  expect_refusal("time_s,current_A\n0,1\n", {"no channel position", "current_A"}, needs_position);
}

TEST(Csv, RefusesQuantitiesThatNoValveHas) {
  expect_refusal("time_s,position_m\n0,0\n0.1,2.4\n", {"position", "2.4 m", "mm"});
  expect_refusal("time_s,oil_temperature_K\n0,50\n0.1,51\n", {"oil_temperature", "50 K", "C or K"});
  expect_refusal("time_s,pressure_upstream_Pa\n0,10\n0.1,60\n", {"pressure_upstream", "implausibly small", "bar"});
  expect_refusal("time_s,current_A\n0,100\n0.1,1500\n", {"1500 A", "mA"});
  EXPECT_NO_THROW((void)read_text("time_s,pressure_upstream_Pa\n0,0\n0.1,0\n"));  // no pressure at all is a test, too
}

TEST(Csv, ReadsPositionInPercentOnlyWhereTheStrokeIsKnown) {
  const std::string text = "time_s,position_percent\n0,0\n0.1,50\n";
  expect_refusal(text, {"share of a stroke", "to = \"mm\""});
  ReadOptions options;
  options.stroke_m = 2.4e-3;
  EXPECT_NEAR(read_text(text, options)[Channel::position][1], 1.2e-3, 1e-12);
}

TEST(Csv, MapsForeignColumnsWithScaleAndOffset) {
  ReadOptions options;
  options.channels.place = "map.toml, line 1";
  options.channels.sources = {{Channel::time, {"t", "ms", 1, 0, {}}},
                              {Channel::position, {"LVDT", "V", 0.24, -0.6, "mm"}}};
  const Recording recording = read_text("t,LVDT\n0,2.5\n5,12.5\n", options);
  EXPECT_THAT(column(recording, Channel::position),
              ElementsAre(::testing::DoubleNear(0, 1e-12), ::testing::DoubleNear(2.4e-3, 1e-12)));
  EXPECT_DOUBLE_EQ(recording[Channel::time][1], 5e-3);
  options.channels.sources[Channel::current] = {"I", "mA", 1, 0, {}};
  expect_refusal("t,LVDT\n0,2.5\n", {"no column \"I\"", "map.toml, line 1", "\"LVDT\""}, options);
}

TEST(Csv, SurvivesAnyDamage) {
  std::mt19937 random(11);
  const std::string good = "time_s;current_A;position_mm\n0,000;0,1;0,5\n0,001;0,2;0,6\n0,002;;0,7\n";
  for (int k = 0; k < 3000; ++k) {
    std::string text = good;
    for (unsigned n = random() % 4 + 1; n > 0; --n) text[random() % text.size()] = static_cast<char>(random() % 256);
    if (random() % 3 == 0) text.resize(random() % text.size());
    try {
      (void)read_text(text);
    } catch (const RecordingError& error) {
      EXPECT_GT(std::string(error.what()).size(), 20U);
    }
  }
}

TEST(Decimal, AgreesWithFromCharsBitForBit) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> mantissa(-10, 10);
  std::uniform_int_distribution<int> exponent(-12, 9);
  for (int k = 0; k < 20000; ++k) {
    const double value = mantissa(random) * std::pow(10.0, exponent(random));
    const std::string text = k % 3 == 0 ? fmt::format("{}", value)
                                        : (k % 3 == 1 ? fmt::format("{:.4f}", value) : fmt::format("{:.17e}", value));
    double expected = 0;
    std::from_chars(text.data(), text.data() + text.size(), expected);
    const Decimal read = read_decimal(text.data(), text.data() + text.size(), '.');
    EXPECT_EQ(read.value, expected) << text;
    EXPECT_EQ(read.end, text.data() + text.size()) << text;
  }
}

TEST(Decimal, TakesNothingThatIsNoNumber) {
  for (const std::string text : {"", "-", ".", "nan", "inf", "abc", "e5"}) {
    EXPECT_EQ(read_decimal(text.data(), text.data() + text.size(), '.').end, nullptr) << text;
  }
}

TEST(CsvWriter, RoundsToItsDecimalsAndComesBack) {
  std::ostringstream out;
  {
    CsvWriter writer(out);
    writer.header({"a", "b", "c"});
    writer.number(-0.00049, 3);
    writer.number(1234.56789, 2);
    writer.text("x|y");
    writer.end_row();
    writer.number(std::nan(""), 3);
    writer.number(-1.5e20, 1);
    writer.text("quote \" and, comma");
    writer.end_row();
  }
  EXPECT_EQ(out.str(), "a,b,c\n0.000,1234.57,x|y\n,-150000000000000000000.0,\"quote \"\" and, comma\"\n");
}

}  // namespace
}  // namespace spoolflow::recording

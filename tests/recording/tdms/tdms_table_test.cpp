/// TDMS files made by hand, read as any recording is: by the child in a sandbox.
#include "spoolflow/recording/tdms/tdms_table.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/inspection.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/recording/column_of.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/tdms/tdms_file.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<double> column(const std::string& bytes, const std::string& name) {
  return column_of("run.tdms", bytes, name);
}

std::string refused(const std::string& bytes) {
  const TemporaryFile file("run.tdms", bytes);
  return refusal([&] { (void)open_sample_table(file.path()); });
}

using Meta = TdmsMetadata;

TEST(TdmsTable, ReadsChannelsOneBehindTheOtherInSeveralChunks) {
  const std::string metadata = Meta()
                                   .without("/")
                                   .without("/'rig'")
                                   .channel("/'rig'/'i'", Meta::i16, 2)
                                   .channel("/'rig'/'x'", Meta::f64, 2)
                                   .content();
  const std::string chunk = tdms_samples<std::int16_t>({1, -2}) + tdms_samples<double>({0.5, 1.5});
  const std::string next = tdms_samples<std::int16_t>({3, 4}) + tdms_samples<double>({2.5, 3.5});
  const std::string bytes = tdms_segment(metadata, chunk + next) + tdms_segment("", chunk);
  EXPECT_THAT(column(bytes, "rig/i"), ElementsAre(1, -2, 3, 4, 1, -2));
  EXPECT_THAT(column(bytes, "rig/x"), ElementsAre(0.5, 1.5, 2.5, 3.5, 0.5, 1.5));
}

TEST(TdmsTable, ReadsInterleavedSegmentsOfEitherByteOrder) {
  for (const bool big : {false, true}) {
    const std::string metadata =
        Meta(big).channel("/'rig'/'a'", Meta::i16, 2).channel("/'rig'/'b'", Meta::f32, 2).content();
    const std::string rows = tdms_samples<std::int16_t>({300}, big) + tdms_samples<float>({0.25}, big) +
                             tdms_samples<std::int16_t>({-4}, big) + tdms_samples<float>({8}, big);
    const std::string bytes = tdms_segment(metadata, rows, {.interleaved = true}, big);
    EXPECT_THAT(column(bytes, "rig/a"), ElementsAre(300, -4));
    EXPECT_THAT(column(bytes, "rig/b"), ElementsAre(0.25, 8));
  }
}

TEST(TdmsTable, AppendedMetadataChangesOnlyWhatItNames) {
  const std::string first = Meta().channel("/'g'/'a'", Meta::i16, 1).channel("/'g'/'b'", Meta::i32, 1).content();
  const std::string longer = Meta().channel("/'g'/'b'", Meta::i32, 2).content();
  const std::string without = Meta().without("/'g'/'a'").content();
  const std::string as_before = Meta().again("/'g'/'b'").again("/'g'/'a'").content();
  const auto a = tdms_samples<std::int16_t>({7}), b = tdms_samples<std::int32_t>({1}),
             bb = tdms_samples<std::int32_t>({2, 3});
  const std::string bytes = tdms_segment(first, a + b) + tdms_segment(longer, a + bb, {.new_objects = false}) +
                            tdms_segment(without, bb, {.new_objects = false}) + tdms_segment(as_before, bb + a);
  EXPECT_THAT(column(bytes, "g/a"), ElementsAre(7, 7, 7));
  EXPECT_THAT(column(bytes, "g/b"), ElementsAre(1, 2, 3, 2, 3, 2, 3));
}

template <class Number>
void expect_type(std::uint32_t type) {
  const std::string bytes = tdms_segment(Meta().channel("/'g'/'x'", type, 2).content(), tdms_samples<Number>({1, 100}));
  EXPECT_THAT(column(bytes, "g/x"), ElementsAre(1, 100)) << type;
}

TEST(TdmsTable, ReadsEveryTypeOfNumber) {
  expect_type<std::int8_t>(1);
  expect_type<std::int16_t>(2);
  expect_type<std::int32_t>(3);
  expect_type<std::int64_t>(4);
  expect_type<std::uint8_t>(5);
  expect_type<std::uint16_t>(6);
  expect_type<std::uint32_t>(7);
  expect_type<std::uint64_t>(8);
  expect_type<float>(9);
  expect_type<double>(10);
  expect_type<float>(0x19);
  expect_type<double>(0x1A);
  expect_type<std::uint8_t>(0x21);
}

TEST(TdmsTable, ScalesRawNumbersOfDaqmx) {
  Meta metadata;
  metadata.daqmx("/'g'/'linear'", 2, 2, 4)
      .property("NI_Number_Of_Scales", 2U)
      .property("NI_Scaling_Status", "unscaled");
  metadata.property("NI_Scale[1]_Scale_Type", "Linear").property("NI_Scale[1]_Linear_Input_Source", 0U);
  metadata.property("NI_Scale[1]_Linear_Slope", 0.5).property("NI_Scale[1]_Linear_Y_Intercept", 10.0);
  metadata.daqmx("/'g'/'twice'", 2, 0, 4).property("NI_Number_Of_Scales", 3U).property("unit_string", "bar");
  metadata.property("NI_Scale[1]_Scale_Type", "Polynomial").property("NI_Scale[1]_Polynomial_Input_Source", 0U);
  metadata.property("NI_Scale[1]_Polynomial_Coefficients_Size", 3U);
  for (int k = 0; k < 3; ++k)
    metadata.property("NI_Scale[1]_Polynomial_Coefficients[" + std::to_string(k) + "]", k + 1.0);
  metadata.property("NI_Scale[2]_Scale_Type", "Linear").property("NI_Scale[2]_Linear_Input_Source", 1U);
  metadata.property("NI_Scale[2]_Linear_Slope", -1.0).property("NI_Scale[2]_Linear_Y_Intercept", 0.0);
  const std::string bytes =
      tdms_segment(metadata.content(), tdms_samples<std::int16_t>({2, 100, -3, 7}), {.daqmx = true});
  EXPECT_THAT(column(bytes, "g/linear"), ElementsAre(60, 13.5));
  EXPECT_THAT(column(bytes, "g/twice"), ElementsAre(-(1 + 2 * 2 + 3 * 4), -(1 - 2 * 3 + 3 * 9)));
}

/// A waveform of the current and position, and a slower one of the pressure that was begun half a second later.
std::string waveforms() {
  std::vector<double> fast, slow;
  for (int k = 0; k < 2000; ++k) fast.push_back(0.5 + 1e-4 * k);
  for (int k = 0; k < 10; ++k) slow.push_back(60 + k);
  constexpr std::int64_t monday = 3870000000;
  Meta metadata;
  metadata.channel("/'coil'/'current'", Meta::f64, 2000)
      .property("wf_increment", 1e-3)
      .property("unit_string", "A")
      .start(monday);
  metadata.channel("/'coil'/'position'", Meta::f64, 2000)
      .property("wf_increment", 1e-3)
      .property("unit_string", "mm")
      .start(monday);
  metadata.channel("/'oil'/'pressure_difference'", Meta::f64, 10)
      .property("wf_increment", 0.1)
      .property("unit_string", "bar");
  metadata.property("wf_start_offset", 0.25).start(monday, std::uint64_t{1} << 62U);
  return tdms_segment(metadata.content(),
                      tdms_samples<double>(fast) + tdms_samples<double>(fast) + tdms_samples<double>(slow));
}

TEST(TdmsTable, WaveformsOfOtherRatesComeOntoTheTimeOfTheCurrent) {
  const TemporaryFile file("run.tdms", waveforms());
  const Recording run =
      read_recording(file.path(), {.channels = {},
                                   .required = {Channel::current, Channel::position, Channel::pressure_difference},
                                   .optional = {},
                                   .stroke_m = {}});
  ASSERT_EQ(run.size(), 2000U);
  EXPECT_NEAR(run[Channel::time][1500], 1.5, 1e-12);
  EXPECT_NEAR(run[Channel::position][1500], 0.65e-3, 1e-12);
  EXPECT_TRUE(std::isnan(run[Channel::pressure_difference][490]));
  EXPECT_NEAR(run[Channel::pressure_difference][1234], (60 + (1.234 - 0.5) / 0.1) * 1e5, 1);
  EXPECT_THAT(run.resampled,
              HasSubstr("'oil/pressure_difference' from 10 Hz by linear interpolation, missing before 0.5 s"));
}

TEST(TdmsTable, TimesCountFromTheEarliest) {
  WrittenBytes times;
  for (const std::uint64_t fraction : {std::uint64_t{0}, std::uint64_t{1} << 63U})
    times.u64(fraction).put(std::int64_t{3870000000});
  const std::string bytes = tdms_segment(Meta().channel("/'g'/'t'", Meta::time, 2).content(), times.content());
  EXPECT_THAT(column(bytes, "g/t"), ElementsAre(0, 0.5));
}

TEST(TdmsTable, UnfinishedLastSegmentIsReadAsFarAsItGoesAndReported) {
  const std::string metadata =
      Meta().channel("/'g'/'time_s'", Meta::f64, 4).channel("/'g'/'current_A'", Meta::f64, 4).content();
  const std::string numbers = tdms_samples<double>({0, 1, 0.1, 2, 0.2, 3, 0.3});
  const std::string bytes = tdms_segment(metadata, numbers, {.interleaved = true, .unfinished = true});
  EXPECT_THAT(column(bytes, "g/current_A"), ElementsAre(1, 2, 3));
  const TemporaryFile file("run.tdms", bytes);
  EXPECT_THAT(read_recording(file.path(), {}).resampled,
              HasSubstr("lacks the end of its last segment, which was never finished"));
}

TEST(TdmsTable, ZerosBehindTheLastSegmentAreWhatAMachineThatWentDownLeaves) {
  const std::string metadata =
      Meta().channel("/'g'/'time_s'", Meta::f64, 2).channel("/'g'/'current_A'", Meta::f64, 2).content();
  const std::string whole = tdms_segment(metadata, tdms_samples<double>({0, 1, 0.1, 0.2}));
  const TemporaryFile file("run.tdms", whole + std::string(4096, '\0'));
  EXPECT_THAT(read_recording(file.path(), {}).resampled,
              HasSubstr("lacks whatever was to stand in the last 4096 bytes, which begin with zeros"));
}

TEST(TdmsTable, ACurrentWithoutATimeIsInspectedAndReported) {
  Meta metadata;
  metadata.channel("/'g'/'current'", Meta::f64, 2).property("unit_string", "A");
  metadata.channel("/'g'/'voltage'", Meta::f64, 2).property("unit_string", "V").property("wf_increment", 1e-3);
  const TemporaryFile file("run.tdms", tdms_segment(metadata.content(), tdms_samples<double>({1, 2, 3, 4})));
  const Inspection found = inspect(file.path(), {}, [](std::optional<double>, std::uint64_t) {});
  EXPECT_THAT(found.missing, ElementsAre(Channel::time, Channel::position));
}

TEST(TdmsTable, AWaveformIsInspectedWithoutAColumnOfTime) {
  Meta metadata;
  for (const char* channel : {"/'g'/'current'", "/'g'/'position'"}) {
    metadata.channel(channel, Meta::f64, 3).property("wf_increment", 1e-3);
    metadata.property("unit_string", std::string(channel).find("current") == std::string::npos ? "mm" : "A");
  }
  metadata.channel("/'g'/'oil_temperature'", Meta::f64, 3).property("NI_Scale[0]_Scale_Type", "Thermocouple");
  const std::string numbers = tdms_samples<double>({1, 2, 1, 0.1, 0.2, 0.1, 3, 4, 5});
  const TemporaryFile file("run.tdms", tdms_segment(metadata.content(), numbers));
  const Inspection found = inspect(file.path(), {}, [](std::optional<double>, std::uint64_t) {});
  EXPECT_THAT(found.missing, IsEmpty());
  EXPECT_EQ(found.samples, 3U);
  EXPECT_THAT(found.contents.unread,
              ElementsAre("channel 'g/oil_temperature' holds a scale 'Thermocouple', which is not read; write it as "
                          "numbers in its unit"));
}

TEST(TdmsTable, WhatIsNoNumberIsReportedWhereAChannelIsMissing) {
  Meta metadata;
  metadata.channel("/'g'/'note'", Meta::text_type, 1).channel("/'g'/'time_s'", Meta::f64, 1);
  const TemporaryFile file("run.tdms", tdms_segment(metadata.content(), "abc" + tdms_samples<double>({1})));
  EXPECT_THAT(refusal([&] {
                (void)read_recording(file.path(),
                                     {.channels = {}, .required = {Channel::current}, .optional = {}, .stroke_m = {}});
              }),
              HasSubstr("channel 'g/note' holds text, which is not read; write it as numbers in its unit"));
}

/// One segment of the current with these wf_ properties, the start in seconds since 1904 (0: not said again).
std::string wave_segment(const std::vector<double>& values, std::int64_t start, std::uint64_t fraction = 0,
                         double offset_s = 0, double step_s = 0) {
  Meta metadata;
  metadata.channel("/'g'/'current_A'", Meta::f64, values.size());
  if (start > 0) metadata.start(start, fraction);
  if (offset_s > 0) metadata.property("wf_start_offset", offset_s);
  if (step_s > 0) metadata.property("wf_increment", step_s);
  return tdms_segment(metadata.content(), tdms_samples<double>(values));
}

std::vector<double> times_of(const std::string& bytes) {
  const TemporaryFile file("run.tdms", bytes);
  return read_recording(file.path(), {.channels = {}, .required = {Channel::current}, .optional = {}, .stroke_m = {}})
      .column(Channel::time);
}

constexpr std::int64_t noon = 3'800'000'000;

TEST(TdmsWaves, ASegmentThatStartsFiveSecondsLaterLeavesAGap) {
  const std::string bytes = wave_segment({1, 1, 1}, noon, 0, 0, 0.25) + wave_segment({1, 1}, noon + 5);
  EXPECT_THAT(times_of(bytes), ElementsAre(0, 0.25, 0.5, 5, 5.25));
  const TemporaryFile file("run.tdms", wave_segment(std::vector<double>(50, 1), noon, 0, 0, 0.01) +
                                           wave_segment(std::vector<double>(50, 1), noon + 5));
  const Inspection found = inspect(file.path(), {}, [](std::optional<double>, std::uint64_t) {});
  EXPECT_EQ(found.gap_count, 1U);
  EXPECT_NEAR(found.end_s, 5.49, 1e-9);
}

TEST(TdmsWaves, SegmentsThatSayTheSameStartOrFollowOnEachOtherHaveNoGap) {
  const std::uint64_t half = std::uint64_t{1} << 63U;
  const std::vector<double> two{1, 1};
  EXPECT_THAT(times_of(wave_segment(two, noon, 0, 0, 0.25) + wave_segment(two, noon) + wave_segment(two, 0)),
              ElementsAre(0, 0.25, 0.5, 0.75, 1, 1.25));
  EXPECT_THAT(
      times_of(wave_segment(two, noon, 0, 0, 0.25) + wave_segment(two, noon, half) + wave_segment(two, noon + 1)),
      ElementsAre(0, 0.25, 0.5, 0.75, 1, 1.25));
}

TEST(TdmsWaves, AStartOffsetOfALaterSegmentCounts) {
  EXPECT_THAT(times_of(wave_segment({1, 1}, noon, 0, 0, 0.25) + wave_segment({1, 1}, 0, 0, 3)),
              ElementsAre(0, 0.25, 3, 3.25));
}

TEST(TdmsWaves, AnotherIncrementChangesTheRateFromThereOn) {
  EXPECT_THAT(times_of(wave_segment({1, 1}, noon, 0, 0, 0.25) + wave_segment({1, 1, 1}, 0, 0, 0, 0.125)),
              ElementsAre(0, 0.25, 0.5, 0.625, 0.75));
  EXPECT_THAT(times_of(wave_segment({1, 1}, noon, 0, 0, 0.25) + wave_segment({1, 1}, noon + 2, 0, 0, 0.125)),
              ElementsAre(0, 0.25, 2, 2.125));
}

TEST(TdmsWaves, AClockReadAFewStepsEarlyDoesNotTurnTheTimeBackButALongWayBackIsRefused) {
  const std::vector<double> many(20, 1);
  const std::uint64_t tenth = ~std::uint64_t{0} / 10;
  const std::vector<double> even = times_of(wave_segment(many, noon, 0, 0, 0.05) + wave_segment(many, noon, 9 * tenth));
  EXPECT_NEAR(even.at(20), 1.0, 1e-9);  // said to be 0.9 s
  EXPECT_THAT(refusal([&] { (void)times_of(wave_segment(many, noon, 0, 0, 0.05) + wave_segment(many, noon - 60)); }),
              HasSubstr("sample 21: time runs backwards"));
}

TEST(TdmsWaves, WhatIsSaidBehindTheLastSampleDoesNotMoveTheSamples) {
  const std::string closing = tdms_segment(Meta().without("/'g'/'current_A'").start(noon + 60).content(), "");
  EXPECT_THAT(times_of(wave_segment({1, 1}, noon, 0, 0, 0.25) + closing), ElementsAre(0, 0.25));
}

TEST(TdmsTable, OfACutSegmentAllChannelsAreReadAsFarAsAllGo) {
  const std::string metadata =
      Meta().channel("/'g'/'time_s'", Meta::f64, 8).channel("/'g'/'current_A'", Meta::f64, 8).content();
  const std::string whole = tdms_segment(
      metadata, tdms_samples<double>({0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 8, 7, 6, 5, 4, 3, 2, 1}));
  const std::string cut = whole.substr(0, whole.size() - 20);
  EXPECT_THAT(column(cut, "g/current_A"), ElementsAre(8, 7, 6, 5, 4));
  EXPECT_THAT(column(cut, "g/time_s"), ElementsAre(0, 0.125, 0.25, 0.375, 0.5));
  const TemporaryFile file("run.tdms", cut);
  EXPECT_THAT(read_recording(file.path(), {}).resampled, HasSubstr("lacks the end of its last segment, 20 bytes"));
  const TemporaryFile half("run.tdms", whole.substr(0, whole.size() - 70));
  EXPECT_THAT(
      refusal([&] {
        (void)read_recording(half.path(),
                             {.channels = {}, .required = {Channel::current}, .optional = {}, .stroke_m = {}});
      }),
      HasSubstr("the file lacks the end of its last segment, of which 58 bytes are there, and not of all channels"));
}

TEST(TdmsTable, DamagedFilesAreRefused) {
  EXPECT_THAT(refused("TDSh" + std::string(40, '\0')), HasSubstr("name the file that ends in .tdms"));
  EXPECT_THAT(refused(tdms_segment(Meta().channel("/'g'/'a'", Meta::f64, std::uint64_t{1} << 50U).content(), "x")),
              HasSubstr("samples in a file of"));
  EXPECT_THAT(refused(tdms_segment(Meta().again("/'g'/'a'").content(), "x")), HasSubstr("was not there before"));
  EXPECT_THAT(refused(tdms_segment(Meta().channel("/'g", Meta::f64, 1).content(), "x")), HasSubstr("no path"));
  EXPECT_THAT(refused(tdms_segment(Meta().daqmx("/'g'/'a'", 1, 3, 4).content(), "xxxx")),
              HasSubstr("a number of 2 bytes at byte 3 of a row of 4"));
  EXPECT_THAT(refused(tdms_segment("", "x")), HasSubstr("the first one has no metadata"));
  EXPECT_THAT(refused(tdms_segment(std::string("\x09\0\0\0", 4), "x")), HasSubstr("ends too soon"));
}

}  // namespace
}  // namespace spoolflow::recording

/// MDF 4 files made by hand, read as any recording is: by the child in a sandbox.
#include "spoolflow/recording/mdf4/mdf4_table.hpp"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/inspection.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/recording/column_of.hpp"
#include "tests/recording/mdf4/mdf4_file.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsNan;

std::vector<double> values_of(const std::string& bytes, const std::string& name) {
  return column_of("run.mf4", bytes, name);
}

/// One sorted group of that many records with these channels.
std::string one_group(Mdf4File& file, const std::vector<Mdf4File::Channel>& channels, const std::string& records,
                      std::uint64_t count, std::uint32_t bytes, std::uint32_t invalid_bytes = 0) {
  const auto group = file.group(0, file.channels(channels), "rig", 0, count, bytes, invalid_bytes);
  return file.content(file.data_group(0, group, file.block("##DT", {}, records)));
}

TEST(Mdf4Table, UnpacksBitsOfEitherByteOrder) {
  Mdf4File file;
  // Byte 0: three bits unused, then 12 bits up to byte 1; 2 and 3: -300 with the highest byte first; 4: real numbers.
  const std::string record =
      WrittenBytes().u16(0x0ABC << 3).raw(WrittenBytes(true).put(std::int16_t{-300}).content()).put(0.25F).content();
  const std::string bytes = one_group(file,
                                      {{"packed", "", 0, 0, 0, 0, 12, 3},
                                       {"turned", "", 0, 0, 3, 2, 16},
                                       {"single", "bar", 0, 0, 4, 4, 32},
                                       {"sign", "", 0, 0, 2, 0, 12, 3}},
                                      record + record, 2, 8);
  EXPECT_THAT(values_of(bytes, "packed"), ElementsAre(0xABC, 0xABC));
  EXPECT_THAT(values_of(bytes, "turned"), ElementsAre(-300, -300));
  EXPECT_THAT(values_of(bytes, "single"), ElementsAre(0.25, 0.25));
  EXPECT_THAT(values_of(bytes, "sign"), ElementsAre(0xABC - 0x1000, 0xABC - 0x1000));
}

TEST(Mdf4Table, ConvertsByFormulaeOfNumbersAndByTables) {
  Mdf4File file;
  const std::uint64_t linear = file.conversion(1, {10, 0.5}), rational = file.conversion(2, {0, 1, 0, 0, 0, 4}),
                      between = file.conversion(4, {0, 0, 10, 100}), nearest = file.conversion(5, {0, 7, 10, 8}),
                      ranges = file.conversion(6, {0, 5, 1, 6, 10, 2, -1});
  const std::string records = WrittenBytes().u8(4).u8(6).u8(20).content();
  const auto column = [&](const std::string& name, std::uint64_t conversion) {
    return Mdf4File::Channel{name, "", 0, 0, 0, 0, 8, 0, conversion};
  };
  const std::string bytes =
      one_group(file,
                {column("linear", linear), column("rational", rational), column("between", between),
                 column("nearest", nearest), column("ranges", ranges)},
                records, 3, 1);
  EXPECT_THAT(values_of(bytes, "linear"), ElementsAre(12, 13, 20));
  EXPECT_THAT(values_of(bytes, "rational"), ElementsAre(1, 1.5, 5));
  EXPECT_THAT(values_of(bytes, "between"), ElementsAre(40, 60, 100));
  EXPECT_THAT(values_of(bytes, "nearest"), ElementsAre(7, 8, 8));
  EXPECT_THAT(values_of(bytes, "ranges"), ElementsAre(1, 2, -1));
}

TEST(Mdf4Table, InvalidSamplesAreMissing) {
  Mdf4File file;
  Mdf4File::Channel channel{"x", "", 0, 0, 0, 0, 8};
  channel.invalid_bit = 1;
  const std::string bytes = one_group(file, {channel}, WrittenBytes().u8(5).u8(0).u8(6).u8(2).content(), 2, 1, 1);
  const std::vector<double> values = values_of(bytes, "x");
  ASSERT_EQ(values.size(), 2U);
  EXPECT_EQ(values[0], 5);
  EXPECT_TRUE(std::isnan(values[1]));
}

TEST(Mdf4Table, RecordsGoOnFromBlockToBlockPackedOrNot) {
  Mdf4File file;
  const std::string records = WrittenBytes().u16(1).u16(2).u16(3).u16(4).u16(5).content();
  const auto channel = file.channels({{"x", "", 0, 0, 0, 0, 16}});
  const auto group = file.group(0, channel, "rig", 0, 5, 2);
  const auto list = file.list({file.block("##DT", {}, records.substr(0, 3)), file.packed(records.substr(3, 2)),
                               file.packed(records.substr(5), 2)});
  const auto head = file.block("##HL", {list}, std::string(8, '\0'));
  EXPECT_THAT(values_of(file.content(file.data_group(0, group, head)), "x"), ElementsAre(1, 2, 3, 4, 5));
}

/// Records of two groups in one row: a fast one with current and position, a slow one with the pressure, and texts.
std::string unsorted() {
  Mdf4File file;
  const auto slow = file.group(
      file.group(0, 0, "", 3, 1, 0, 0, 1),
      file.channels({{"t", "s", 2, 1, 4, 0, 64}, {"pressure_difference_bar", "", 0, 0, 4, 8, 64}}), "oil", 2, 11, 16);
  const auto fast = file.group(
      slow,
      file.channels(
          {{"t", "s", 2, 1, 4, 0, 64}, {"current", "mA", 0, 0, 4, 8, 64}, {"position", "mm", 0, 0, 4, 16, 64}}),
      "coil", 1, 1000, 24);
  WrittenBytes records;
  for (int k = 0; k < 1000; ++k) {
    records.u8(1).f64(1e-3 * k).f64(500 + k).f64(0.1 + 1e-4 * k);
    if (k % 100 == 0) records.u8(2).f64(1e-3 * k).f64(60 + 0.01 * k).u8(3).u32(5).raw("texts");
  }
  records.u8(2).f64(1).f64(70);
  return file.content(file.data_group(0, fast, file.block("##DT", {}, records.content()), 1));
}

TEST(Mdf4Table, GroupsOfOtherRatesComeOntoTheTimeOfTheCurrent) {
  const TemporaryFile file("run.mf4", unsorted());
  const Recording run =
      read_recording(file.path(), {.channels = {},
                                   .required = {Channel::current, Channel::position, Channel::pressure_difference},
                                   .optional = {},
                                   .stroke_m = {}});
  ASSERT_EQ(run.size(), 1000U);
  EXPECT_NEAR(run[Channel::time][250], 0.25, 1e-12);
  EXPECT_NEAR(run[Channel::current][250], 0.75, 1e-12);
  EXPECT_NEAR(run[Channel::pressure_difference][250], 62.5e5, 1);
  EXPECT_THAT(run.resampled, HasSubstr("'oil/pressure_difference_bar' from 10 Hz by linear interpolation"));
}

/// By columns: a group with the time, two with a channel each and their time in the first, a slow one with its own.
std::string by_columns() {
  Mdf4File file;
  WrittenBytes time, current, position, position_tail, slow;
  for (int k = 0; k < 20; ++k) {
    time.f64(1e-3 * k);
    current.put(static_cast<float>(500 + k));
    (k < 8 ? position : position_tail).f64(0.1 + 1e-3 * k);
  }
  slow.f64(0).f64(60).f64(0.019).f64(62);
  const auto timed = file.group(0, file.channels({{"t", "s", 2, 1, 4, 0, 64}}), "rig", 0, 20, 8);
  const auto coil = file.group(0, file.channels({{"current", "mA", 0, 0, 4, 0, 32}}), "", 0, 20, 4, 0, 0, timed);
  Mdf4File::Channel spool{"position", "mm", 0, 0, 4, 0, 64};
  spool.invalid_bit = 1;
  const auto place = file.group(0, file.channels({spool}), "", 0, 20, 8, 1, 0, timed);
  const auto oil = file.group(
      0, file.channels({{"t", "s", 2, 1, 4, 0, 64}, {"pressure_difference", "bar", 0, 0, 4, 8, 64}}), "oil", 0, 2, 16);
  const std::string doubt = std::string(12, '\0') + "\1\2" + std::string(6, '\0');
  const auto spread =
      file.columns({file.block("##DV", {}, position.content()), file.packed(position_tail.content(), 8, "DV")},
                   {file.block("##DI", {}, doubt.substr(0, 8)), file.packed(doubt.substr(8), 0, "DI")});
  std::uint64_t last = file.data_group(0, oil, file.block("##DV", {}, slow.content()));
  last = file.data_group(last, place, spread);
  last = file.data_group(last, coil, file.columns({file.block("##DV", {}, current.content())}));
  return file.content(file.data_group(last, timed, file.block("##DV", {}, time.content())));
}

TEST(Mdf4Table, ColumnsHaveTheTimeOfTheGroupThatHoldsIt) {
  const TemporaryFile file("run.mf4", by_columns());
  const Recording run =
      read_recording(file.path(), {.channels = {},
                                   .required = {Channel::current, Channel::position, Channel::pressure_difference},
                                   .optional = {},
                                   .stroke_m = {}});
  ASSERT_EQ(run.size(), 20U);
  EXPECT_NEAR(run[Channel::time][7], 0.007, 1e-12);
  EXPECT_NEAR(run[Channel::current][19], 0.519, 1e-7);
  EXPECT_NEAR(run[Channel::position][7], 0.107e-3, 1e-12);
  EXPECT_NEAR(run[Channel::position][12], 0.112e-3, 1e-12);  // bit 0 says nothing of this channel
  EXPECT_TRUE(std::isnan(run[Channel::position][13]));
  EXPECT_NEAR(run[Channel::pressure_difference][19], 62e5, 1);
  EXPECT_THAT(run.resampled, HasSubstr("'oil/pressure_difference' from"));
}

TEST(Mdf4Table, TheChannelsAreSearchedWhereTheirUnitsIdentifyThem) {
  const TemporaryFile file("run.mf4", by_columns());
  const Inspection found = inspect(file.path(), {}, [](std::optional<double>, std::uint64_t) {});
  EXPECT_EQ(found.samples, 20U);
  EXPECT_NEAR(found.rate_Hz, 1000, 1e-6);
  const auto position = std::ranges::find(found.channels, Channel::position, &ChannelSummary::channel);
  ASSERT_NE(position, found.channels.end());
  EXPECT_EQ(position->missing, 1U);
  EXPECT_NEAR(position->highest, 0.119e-3, 1e-12);
}

/// Of an ECU's signal as its database describes it: 0 to 65000 a current in mA, above "error" and "not available".
TEST(Mdf4Table, TextsAmongNumbersAreMissingSamples) {
  Mdf4File file;
  const std::uint64_t linear = file.conversion(1, {0, 0.5}, {}, "mA"), text = file.text("not available");
  const std::uint64_t by_value = file.conversion(7, {65534, 65535}, {file.text("error"), text, linear});
  const std::uint64_t by_range = file.conversion(8, {65001, 65535}, {text, linear});
  const std::uint64_t turned = file.conversion(8, {0, 65000}, {linear, text});
  const auto column = [&](const std::string& name, std::uint64_t conversion) {
    return Mdf4File::Channel{name, "", 0, 0, 0, 0, 16, 0, conversion};
  };
  const std::string bytes =
      one_group(file, {column("by_value", by_value), column("by_range", by_range), column("turned", turned)},
                WrittenBytes().u16(2000).u16(65535).u16(65000).content(), 3, 2);
  for (const char* name : {"by_value", "by_range", "turned"})
    EXPECT_THAT(values_of(bytes, name), ElementsAre(1000, IsNan(), 32500)) << name;
  const TemporaryFile written("run.mf4", bytes);
  EXPECT_THAT(contents_of(written.path()).columns, Each(Field(&FileColumn::unit, "mA")));
}

TEST(Mdf4Table, AConversionThatLeadsToItselfEnds) {
  Mdf4File file;
  const std::uint64_t text = file.text("no"), at = file.conversion(7, {1, 2}, {text, text, text});
  std::string bytes = one_group(file, {{"x", "", 0, 0, 0, 0, 8, 0, at}}, "a", 1, 1);
  constexpr std::size_t answers = 24 + 4 * 8;
  for (std::size_t k = 0; k < 3; ++k) bytes.replace(at + answers + 8 * k, 8, WrittenBytes().u64(at).content());
  const TemporaryFile written("run.mf4", bytes);
  EXPECT_THAT(contents_of(written.path()).unread, ElementsAre(HasSubstr("many tables within tables")));
}

TEST(Mdf4Table, ReadsNumbersOfHalfPrecision) {
  Mdf4File file;
  const std::string bytes =
      one_group(file, {{"x", "", 0, 0, 4, 0, 16}},
                WrittenBytes().u16(0x3C00).u16(0xC100).u16(0x7BFF).u16(0x0001).u16(0xFE00).content(), 5, 2);
  EXPECT_THAT(values_of(bytes, "x"), ElementsAre(1, -2.5, 65504, 0x1p-24, IsNan()));
}

TEST(Mdf4Table, GroupsOfOneNameAreDistinguished) {
  Mdf4File file;
  const auto group = [&](const char* name, double first) {
    const std::string records = WrittenBytes().f64(0).f64(first).f64(1).f64(first).content();
    return std::pair(
        file.group(0, file.channels({{"t", "s", 2, 1, 4, 0, 64}, {name, "", 0, 0, 4, 8, 64}}), "CAN1", 0, 2, 16),
        file.block("##DT", {}, records));
  };
  const auto [coil, coil_records] = group("current", 1);
  const auto [spool, spool_records] = group("position", 2);
  const std::string bytes = file.content(file.data_group(file.data_group(0, spool, spool_records), coil, coil_records));
  EXPECT_THAT(values_of(bytes, "CAN1/current"), ElementsAre(1, 1));
  EXPECT_THAT(values_of(bytes, "CAN1 #2/position"), ElementsAre(2, 2));
}

TEST(Mdf4Table, WhatIsNotReadBesideTheNumbersIsReported) {
  Mdf4File file;
  const auto virtual_alone = file.group(0, file.channels({{"t", "s", 3, 1, 0, 0, 0}}), "clock", 0, 10, 0);
  const auto group = file.group(0,
                                file.channels({{"x", "", 0, 0, 0, 0, 8},
                                               {"note", "", 0, 0, 7, 0, 8},
                                               {"oil_temperature", "", 0, 0, 7, 0, 8},
                                               {"time_s", "", 0, 0, 0, 0, 8},
                                               {"current_A", "", 0, 0, 0, 0, 8}}),
                                "rig", 0, 1, 1);
  const auto last = file.data_group(0, group, file.block("##DT", {}, "a"));
  const TemporaryFile written("run.mf4", file.content(file.data_group(last, virtual_alone, 0)));
  EXPECT_THAT(contents_of(written.path()).unread,
              ElementsAre(HasSubstr("group 'clock' has 10 records without a byte"), HasSubstr("'note' holds text"),
                          HasSubstr("'oil_temperature' holds text")));
  ReadOptions options;
  options.required = {Channel::current};
  options.optional = {Channel::oil_temperature};
  EXPECT_EQ(open_reader(written.path(), options)->notes().resampled,
            "channel 'oil_temperature' holds text, which is not read; write it as numbers in its unit");
  options.channels.sources[Channel::voltage] = {"rig/note", "V", 1, 0, {}};
  options.required = {Channel::voltage};
  EXPECT_THAT(refusal([&] { (void)open_reader(written.path(), options); }),
              HasSubstr("does not have; channel 'note' holds text, which is not read"));
}

TEST(Mdf4Table, AFileWithoutRecordsIsReported) {
  Mdf4File file;
  const TemporaryFile written("run.mf4", file.content(0));
  EXPECT_THAT(contents_of(written.path()).unread, ElementsAre(HasSubstr("no group of it holds records of numbers")));
}

TEST(Mdf4Table, WhatIsNoNumberIsReported) {
  Mdf4File file;
  const std::uint64_t texts = file.conversion(7, {});
  const std::string bytes = one_group(file, {{"t", "s", 2, 1, 4, 0, 64}, {"state", "", 0, 0, 0, 8, 8, 0, texts}},
                                      WrittenBytes().f64(1).u8(1).content(), 1, 9);
  const TemporaryFile written("run.mf4", bytes);
  EXPECT_THAT(refusal([&] {
                (void)read_recording(written.path(),
                                     {.channels = {}, .required = {Channel::current}, .optional = {}, .stroke_m = {}});
              }),
              HasSubstr("channel 'state' holds texts in the place of numbers, which is not read"));
}

std::string refused_mdf4(const std::string& bytes) {
  const TemporaryFile file("run.mf4", bytes);
  return refusal([&] { (void)open_sample_table(file.path()); });
}

TEST(Mdf4Table, OtherVersionsAndDamagedFilesAreRefused) {
  EXPECT_THAT(refused_mdf4("MDF     3.30    " + std::string(200, '\0')),
              HasSubstr("version 3.30, where 4 is read; save it as MDF 4"));
  Mdf4File unfinished("UnFinMF 4.10    ");
  EXPECT_THAT(refused_mdf4(unfinished.content(0)), HasSubstr("was not finished by the program that recorded it"));
  Mdf4File beyond;
  EXPECT_THAT(refused_mdf4(one_group(beyond, {{"x", "", 0, 0, 0, 1, 16}}, "xx", 1, 2)),
              HasSubstr("16 bits at byte 1 of records of 2 bytes"));
  Mdf4File too_many;
  EXPECT_THAT(refused_mdf4(one_group(too_many, {{"x", "", 0, 0, 0, 0, 16}}, "xx", 2, 2)),
              HasSubstr("2 records of 2 bytes in 2 bytes of data"));
  Mdf4File unlike;
  const auto timed = unlike.group(0, unlike.channels({{"t", "s", 2, 1, 4, 0, 64}}), "rig", 0, 1, 8);
  const auto other = unlike.group(0, unlike.channels({{"x", "", 0, 0, 0, 0, 16}}), "more", 0, 2, 2, 0, 0, timed);
  const auto values = unlike.block("##DV", {}, "abcd"), time = unlike.block("##DV", {}, std::string(8, '\0'));
  const auto last = unlike.data_group(0, other, values);
  EXPECT_THAT(refused_mdf4(unlike.content(unlike.data_group(last, timed, time))),
              HasSubstr("group 'more': 2 records, where the group that holds its time has 1"));
  Mdf4File lists;
  const auto few = lists.group(0, lists.channels({{"x", "", 0, 0, 0, 0, 16}}), "rig", 0, 1, 2);
  const auto ld = lists.block("##LD", {0}, WrittenBytes().u32(0).u32(1).content());
  EXPECT_THAT(refused_mdf4(lists.content(lists.data_group(0, few, ld))),
              HasSubstr("1 blocks are said to be listed by 0 links"));
  Mdf4File cut;
  const std::string whole = one_group(cut, {{"x", "", 0, 0, 0, 0, 16}}, "xx", 1, 2);
  EXPECT_THAT(refused_mdf4(whole.substr(0, whole.size() - 40)), HasSubstr("is cut short or damaged"));
  Mdf4File round;
  const auto group = round.group(0, 0, "rig", 0, 0, 2);
  EXPECT_THAT(refused_mdf4(round.content(round.data_group(round.data_group(0, group, 0), group, 0))),
              HasSubstr("round in a circle"));
}

}  // namespace
}  // namespace spoolflow::recording

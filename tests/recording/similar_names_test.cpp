/// A channel is found however its name is written, and what may be one by another name is reported, never left out
/// without a word.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/files/header_name.hpp"
#include "spoolflow/recording/proposal.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

using testing::HasSubstr;

ReadOptions of_a_sensor() {
  ReadOptions out;
  out.required = {Channel::time, Channel::current, Channel::position};
  out.optional = {Channel::voltage, Channel::oil_temperature};
  return out;
}

std::unique_ptr<Reader> reader_of(const TemporaryFile& file) {
  return open_reader(file.path(), of_a_sensor());
}

TEST(SimilarNames, OfTheOilTemperatureAreRead) {
  for (const char* name : {"Oil_Temperature_degC",
                           "Oil Temperature [\xC2\xB0"
                           "C]",
                           "Oil_temperature_C", "oil temperature [degC]", "OIL_TEMPERATURE (C)", "OilTemperature_degC",
                           "oil-temperature [C]"}) {
    const TemporaryFile file("run.csv", "time_s,current_A,position_mm," + std::string(name) +
                                            "\n0,0.5,0.1,40\n0.001,0.5,0.1,40\n0.002,0.5,0.1,40\n");
    SampleBlock block;
    const auto reader = reader_of(file);
    ASSERT_TRUE(reader->next(block)) << name;
    ASSERT_TRUE(reader->has(Channel::oil_temperature)) << name;
    EXPECT_DOUBLE_EQ(block.columns[static_cast<std::size_t>(Channel::oil_temperature)][0], 313.15) << name;
    EXPECT_EQ(reader->notes().resampled, "") << name;
  }
}

TEST(SimilarNames, ServeForEveryChannelAndStandBehindTheChannelsOwn) {
  const TemporaryFile file("run.csv",
                           "Time [ms],Current_A,Position (um),current_A,Voltage_V\n"
                           "0,9,100,0.5,12\n1,9,100,0.5,12\n2,9,100,0.5,12\n");
  SampleBlock block;
  const auto reader = reader_of(file);
  ASSERT_TRUE(reader->next(block));
  const auto second = [&](Channel channel) { return block.columns[static_cast<std::size_t>(channel)][1]; };
  EXPECT_DOUBLE_EQ(second(Channel::time), 0.001);
  EXPECT_DOUBLE_EQ(second(Channel::current), 0.5);
  EXPECT_DOUBLE_EQ(second(Channel::position), 1e-4);
  EXPECT_DOUBLE_EQ(second(Channel::voltage), 12);
}

TEST(SimilarNames, TellACoilFromTheUnitOfItsCurrent) {
  const auto channel = [](const std::string& name, const std::string& unit = "") {
    const auto header = channel_header({name, name, unit});
    return header ? std::string(spoolflow::recording::name(header->channel)) + " in " + header->unit : "none";
  };
  EXPECT_EQ(channel("Current_A"), "current in A");
  EXPECT_EQ(channel("current_A"), "current in A");
  EXPECT_EQ(channel("current_a", "A"), "current_a in A");
  EXPECT_EQ(channel("Current_a", "mA"), "current_a in mA");
  EXPECT_EQ(channel("Current_B", "A"), "current_b in A");
  EXPECT_EQ(channel("Pressure_P [bar]"), "pressure_p in bar");
  EXPECT_EQ(channel("Voltage_B [V]"), "voltage_b in V");
  EXPECT_EQ(channel("Position_Set_1"), "position_set in 1");
  EXPECT_EQ(channel("Position_Set [%]"), "position_set in %");
}

TEST(SimilarNames, DoNotCountWithoutAUnitOfTheChannel) {
  for (const std::string name :
       {"Flow", "Time", "Test", "Test [1]", "Position [V]", "Flow_1", "Currents_A", "Forces [N]"})
    EXPECT_FALSE(channel_header({name, name, ""})) << name;
}

TEST(SimilarNames, OfTwoColumnsAreRefusedByName) {
  const TemporaryFile file("run.csv",
                           "time_s,Current [A],CURRENT [A],position_mm\n0,9,8,1\n0.001,9,8,1\n0.002,9,8,1\n");
  EXPECT_THAT(
      refusal([&] { (void)reader_of(file); }),
      testing::AllOf(HasSubstr("'Current [A]'"), HasSubstr("'CURRENT [A]'"), HasSubstr("are both channel current")));
}

TEST(SimilarNames, InOneUnitWithAnotherBesideAreRefused) {
  for (const std::string column : {"current_A [mA]", "Current_A (mA)"}) {
    const TemporaryFile file("run.csv", "time_s," + column + ",position_mm\n0,9,1\n0.001,9,1\n0.002,9,1\n");
    EXPECT_THAT(refusal([&] { (void)reader_of(file); }), HasSubstr("is A by its name and mA by what stands beside it"));
  }
}

TEST(OtherNames, OfAChannelThatIsMissingAreReported) {
  for (const auto& [column, channel] : std::vector<std::pair<std::string, std::string>>{
           {"T_oil [degC]", "oil_temperature"}, {"Temperature", "oil_temperature"}, {"U_coil [V]", "voltage"}}) {
    const TemporaryFile file("run.csv",
                             "time_s,current_A,position_mm," + column + "\n0,0.5,0.1,40\n0.001,0.5,0.1,40\n");
    EXPECT_THAT(reader_of(file)->notes().resampled,
                HasSubstr("column '" + column + "' is not read: if it is " + channel))
        << column;
  }
}

TEST(OtherNames, OfAChannelThatIsNeededStandInItsRefusal) {
  const TemporaryFile file("run.csv", "time_s,coil current (mA),position_mm\n0,500,0.1\n0.001,500,0.1\n");
  EXPECT_THAT(refusal([&] { (void)reader_of(file); }),
              HasSubstr("channel current is missing; 'coil current (mA)' may be it"));
}

ChannelMap proposed(const std::vector<std::string>& columns) {
  FileContents contents;
  for (const std::string& column : columns) contents.columns.push_back({column, column, ""});
  return propose_channels(contents).map;
}

TEST(OtherNames, OfOneCurrentWithAnAHoldItsUnitAndOfTwoTheirCoils) {
  for (const char* name : {"Current, A", "Current A", "Coil current A", "Strom, A"}) {
    const ChannelMap map = proposed({"Time, s", name, "Position, mm"});
    ASSERT_TRUE(map.sources.contains(Channel::current)) << name;
    EXPECT_EQ(map.sources.at(Channel::current).unit, "A") << name;
    EXPECT_FALSE(map.sources.contains(Channel::current_a)) << name;
  }
  const ChannelMap both = proposed({"Time, s", "Current A", "Current B", "Position, mm"});
  EXPECT_TRUE(both.sources.contains(Channel::current_a) && both.sources.contains(Channel::current_b));
  EXPECT_FALSE(both.sources.contains(Channel::current));
}

TEST(OtherNames, OfChannelsThatAreReadAreNoNews) {
  const TemporaryFile file("run.csv",
                           "time_s,current_A,position_mm,oil_temperature_degC,T_tank [degC],Temp [degC],rpm\n"
                           "0,0.5,0.1,40,30,20,7\n0.001,0.5,0.1,40,30,20,7\n");
  EXPECT_EQ(reader_of(file)->notes().resampled, "");
}

}  // namespace
}  // namespace spoolflow::recording

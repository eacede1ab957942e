/// Samples in messages of a broker: every form gives the same samples, and what is none harms nobody.
#include "addons/live/sources/message_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "addons/live/sources/message_text.hpp"
#include "addons/live/sources/unknown_senders.hpp"
#include "addons/live/tests/engine_site.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"

namespace spoolflow::live {
namespace {

using ::testing::HasSubstr;

std::string unreadable(const std::string& message) {
  try {
    (void)message_text(message);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(MessageText, ColumnsSamplesAndAListOfThemAreTheSameLines) {
  for (const char* message : {R"({"valve": {"serial": 7}, "x": [1, 2], "time_s": [0.5, null]})",
                              R"([{"time_s": 0.5, "x": 1}, {"x": 2, "more": 9}])"}) {
    const MessageText text = message_text(message);
    EXPECT_EQ(text.header, R"("time_s","x")") << message;
    EXPECT_EQ(text.rows, "0.5,1\n,2\n") << message;
    EXPECT_EQ(text.samples, 2U);
  }
  EXPECT_EQ(message_text(R"({"on": true, "at": "2026-11-27T10:00:00Z", "x": 1e-3})").rows,
            "\"2026-11-27T10:00:00Z\",1,0.001\n");
}

TEST(MessageText, CsvStandsWithOrWithoutItsHeader) {
  const MessageText with = message_text("time_s,x\r\n1,2\r\n3,4");
  EXPECT_EQ(with.header, "time_s,x");
  EXPECT_EQ(with.rows, "1,2\r\n3,4\n");
  for (const char* rows : {"1,2\n", "2026-11-27T10:00:00Z;5\n", ",5\n", "nan,5\n", "-1,5\n"}) {
    EXPECT_EQ(message_text(rows).header, "") << rows;
  }
  EXPECT_EQ(message_text("nanoseconds,x\n1,2\n").header, "nanoseconds,x");
}

TEST(MessageText, SaysWhatIsNoMessage) {
  EXPECT_THAT(unreadable(R"({"x": NaN})"), HasSubstr("no JSON at byte"));
  EXPECT_THAT(unreadable(R"({"a": [1], "b": [1, 2]})"), HasSubstr("columns a and b have 1 and 2 values"));
  EXPECT_THAT(unreadable("[1, 2]"), HasSubstr("no sample"));
  for (const char* empty : {"", " ", "[]", "{}", "time_s,x\n"}) EXPECT_NE(unreadable(empty), "") << empty;
  EXPECT_THAT(unreadable(std::string(largest_message + 1, '1')), HasSubstr("at most 1048576"));
}

class MessageSourceTest : public ::testing::Test {
 protected:
  Intake intake{[] {}};
  MessageSource source{"hall/press_1",
                       estimation::sensor_channels(model::read_model(SPOOLFLOW_EXAMPLE_MODEL), recording::ChannelMap{}),
                       {},
                       intake};
  std::vector<estimation::TimedSample> samples;

  bool come(std::size_t count) {
    return comes_true([&] {
      std::vector<SampleBlock> blocks;
      intake.take(blocks);
      for (const SampleBlock& block : blocks) samples.insert(samples.end(), block.samples.begin(), block.samples.end());
      return samples.size() >= count;
    });
  }
};

TEST_F(MessageSourceTest, ReadsEveryFormInTheUnitsThatNamesState) {
  source.take(
      R"({"time_ms": [1, 2], "current_mA": [500, 600], "position_mm": [0.25, 0.5], "oil_temperature_C": [50, 50]})");
  source.take("time_s,current_A,position_m,oil_temperature_K\n0.003,0.7,0.00075,323.15\n");
  source.take("0.004,0.8,0.001,323.15\n");
  source.take("time_s,current_A,position_m,oil_temperature_K\n0.005,0.9,0.00125,323.15\n");
  ASSERT_TRUE(come(5)) << intake.trouble();
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(samples[k].time_s, 1e-3 * static_cast<double>(k + 1), 1e-12);
    EXPECT_NEAR(samples[k].current_A, 0.5 + 0.1 * static_cast<double>(k), 1e-12);
    EXPECT_NEAR(samples[k].position_m, 0.25e-3 * static_cast<double>(k + 1), 1e-12);
    EXPECT_NEAR(samples[k].oil_temperature_K, 323.15, 1e-9);
  }
  EXPECT_EQ(intake.counters().connections, 2U);  // other columns: another sender
  EXPECT_EQ(intake.trouble(), "");
}

TEST_F(MessageSourceTest, CountsWhatItCannotReadAndGoesOn) {
  source.take("1,2\n");
  EXPECT_THAT(intake.trouble(), HasSubstr("no header"));
  source.take("{\"time_s\": NaN}");
  EXPECT_EQ(intake.counters().unreadable, 2U);
  source.take(R"({"time_s": 1, "temperature": 3})");  // nothing of a valve
  EXPECT_TRUE(comes_true([&] { return intake.trouble().find("current is missing") != std::string::npos; }))
      << intake.trouble();
  source.take(R"({"time_s": 1, "current_A": 0.5, "position_m": 0.001})");
  EXPECT_TRUE(come(1));
  EXPECT_EQ(intake.trouble(), "");
}

TEST(MessageTopic, HasTheIdInItsPlace) {
  EXPECT_EQ(id_in_topic("hall/+/samples", "hall/press_1/samples"), "press_1");
  EXPECT_EQ(id_in_topic("+", "press_1"), "press_1");
  for (const char* other : {"hall/press_1", "hall//samples", "hall/a/b/samples", "yard/press_1/samples"})
    EXPECT_EQ(id_in_topic("hall/+/samples", other), std::nullopt) << other;
  EXPECT_EQ(id_in_topic("", "press_1"), std::nullopt);
}

}  // namespace
}  // namespace spoolflow::live

#include "addons/live/protocols/sparkplug.hpp"

#include <gtest/gtest.h>

namespace spoolflow::fieldbus {
namespace {

using namespace std::string_literals;

TEST(Sparkplug, WritesTheBytesOfProtocolBuffers) {
  // timestamp 300, one metric "a" of time 1, Int64 5, sequence 7
  const std::string bytes = sparkplug_bytes({300, 7, {{"a", 1, std::int64_t{5}}}});
  EXPECT_EQ(bytes, "\x08\xAC\x02\x12\x09\x0A\x01\x61\x18\x01\x20\x04\x58\x05\x18\x07"s);
}

TEST(Sparkplug, OfADeathHasNoSequence) {
  EXPECT_EQ(sparkplug_bytes({1, -1, {}}), "\x08\x01"s);
}

TEST(Sparkplug, WritesWhatIsNotKnownAsNull) {
  EXPECT_EQ(sparkplug_bytes({1, -1, {{"a", 1, std::nan("")}}}),
            "\x08\x01\x12\x09\x0A\x01\x61\x18\x01\x20\x0A\x38\x01"s);
}

TEST(Sparkplug, HearsAnOrderForANewBirth) {
  EXPECT_TRUE(asks_for_rebirth(sparkplug_bytes({1, -1, {{"x", 1, true}, {"Node Control/Rebirth", 1, true}}})));
  EXPECT_FALSE(asks_for_rebirth(sparkplug_bytes({1, -1, {{"Node Control/Rebirth", 1, false}}})));
  EXPECT_FALSE(asks_for_rebirth(sparkplug_bytes({1, -1, {{"Node Control/Reboot", 1, true}}})));
}

TEST(Sparkplug, TakesNoHarmFromCutOrdersNorFromNoise) {
  const std::string whole = sparkplug_bytes({1, -1, {{"Node Control/Rebirth", 1, true}}});
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_FALSE(asks_for_rebirth(whole.substr(0, size)));
  EXPECT_FALSE(asks_for_rebirth(std::string(100, '\xFF')));
}

TEST(Sparkplug, SendsWhatChangedAlone) {
  PlantAnswer before;
  before.flow_m3_per_s = 1e-4;
  PlantAnswer now = before;
  now.flow_m3_per_s = 2e-4;
  const auto changed = changed_metrics(valve_metrics(before, 1), valve_metrics(now, 2));
  ASSERT_EQ(changed.size(), 1U);
  EXPECT_EQ(changed[0].name, "Flow/L_min");
  EXPECT_EQ(changed[0].time_ms, 2);
  EXPECT_EQ(changed_metrics({}, valve_metrics(now, 2)).size(), valve_metrics(now, 2).size());
}

}  // namespace
}  // namespace spoolflow::fieldbus

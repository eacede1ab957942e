#include <gmock/gmock.h>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::HasSubstr;

class Recalibrate : public CommandLine {
 protected:
  /// What is said of the example's run beside its meter, read with that channel map.
  [[nodiscard]] Answer said_with(const std::string& channel) const {
    write("meter.toml", "[[reference]]\nkind = \"meter\"\n");
    write("map.toml", "[channels]\n" + channel + "\n");
    return run("recalibrate " SPOOLFLOW_EXAMPLE_MODEL " " SPOOLFLOW_EXAMPLES
               "/valve_a/duty_cycle_1.h5 --references meter.toml --channels map.toml -o moved.json -q");
  }
};

TEST_F(Recalibrate, ARecordingThatCannotBeSoundIsNamedBesideWhatItMovesOrIsRefusedFor) {
  const Answer turned = said_with("position = { column = \"position_mm\", unit = \"mm\", scale = -1 }");
  EXPECT_EQ(turned.status, 2);
  EXPECT_THAT(turned.message, HasSubstr("likely the recordings are wrong: duty_cycle_1.h5: position looks of the wrong "
                                        "sign"));
  const Answer hot = said_with(
      "oil_temperature = { column = \"oil_temperature_C\", unit = \"C\", scale = 1.8, offset = 32, to = \"C\" }");
  EXPECT_THAT(hot.message, HasSubstr("oil_temperature looks in degF, not degC"));
}

TEST_F(Recalibrate, ASoundRecordingRaisesNoDoubt) {
  const Answer sound = said_with("current = { column = \"current_A\", unit = \"A\" }");
  ASSERT_EQ(sound.status, 0) << sound.message;
  EXPECT_EQ(sound.message, "");
}

}  // namespace
}  // namespace spoolflow::apps

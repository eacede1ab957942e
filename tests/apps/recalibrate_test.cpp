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

TEST_F(Recalibrate, TheFileOfMarksThatReferencesNameIsNotOverwritten) {
  const std::string marks = "begin_s,end_s\n1,60\n";
  write("marks.csv", marks);
  write("boom.toml",
        "[[reference]]\nkind = \"stroke\"\nends = \"marks\"\nmarks = \"marks.csv\"\narea_cm2 = 300\nlength_mm = 650\n");
  const Answer refused = run("recalibrate " SPOOLFLOW_EXAMPLE_MODEL " " SPOOLFLOW_EXAMPLES
                             "/valve_a/duty_cycle_1.h5 --references boom.toml -o marks.csv -q");
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(content("marks.csv"), marks);
  EXPECT_THAT(refused.message, HasSubstr("cannot write marks.csv: this command also uses"));
}

TEST_F(Recalibrate, MarksAreTimesOfTheOneRecordingThatTheirReferenceNames) {
  write("marks.csv", "begin_s,end_s\n1,60\n");
  write("run.csv", "");
  std::filesystem::create_directory(folder / "tuesday");
  write("tuesday/run.csv", "");
  const std::string pump =
      "[[reference]]\nkind = \"pump\"\nmarks = \"marks.csv\"\ndisplacement_cm3 = 20\nspeed_rpm = 1500\n";
  write("of_which.toml", pump);
  write("of_both.toml", pump + "recording = \"run.csv\"\n");
  const std::string begin =
      "recalibrate " SPOOLFLOW_EXAMPLE_MODEL " run.csv tuesday/run.csv -o moved.json --references ";
  EXPECT_THAT(run(begin + "of_which.toml").message,
              HasSubstr("line 1: pump 1 does not say of which of the 2 recordings its marks are; write recording = "
                        "\"run.csv\""));
  EXPECT_THAT(run(begin + "of_both.toml").message,
              HasSubstr("pump 1 is of the recording run.csv, and 2 of the files given have that name"));
}

TEST_F(Recalibrate, AStateThatNoModelHasIsNamedAsItWasWritten) {
  const Answer refused = run("recalibrate " SPOOLFLOW_EXAMPLE_MODEL " --back-to -1 -o moved.json");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.message, HasSubstr("--back-to: Value -1 is no whole number from 0 on"));
}

}  // namespace
}  // namespace spoolflow::apps

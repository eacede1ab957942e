/// `spoolflow export fmu`: which file comes out of what, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class ExportFmu : public CommandLine {
 protected:
  const std::string model = SPOOLFLOW_EXAMPLE_MODEL;
};

TEST_F(ExportFmu, WritesOneArchiveForEitherVersionOfTheStandard) {
  for (const char* version : {"2", "3"}) {
    const Answer answer = run("export fmu '" + model + "' -o sensor.fmu --fmi " + version);
    ASSERT_EQ(answer.status, 0) << answer.message;
    EXPECT_THAT(answer.message, IsEmpty());
    EXPECT_THAT(content("sensor.fmu"), StartsWith("PK"));
    const std::string linux_library = *version == '2' ? "binaries/linux64/" : "binaries/x86_64-linux/";
    EXPECT_THAT(content("sensor.fmu"), HasSubstr(linux_library + "spoolflow_sensor.so"));
  }
  EXPECT_EQ(run("export fmu '" + model + "' -o sensor.fmu --fmi 1").status, 2);
}

TEST_F(ExportFmu, TakesAPresetOrAValveFileForTheVirtualValve) {
  write("mine.toml", "preset = \"size_6\"\n[plant.load]\nkind = \"cylinder\"\n");
  for (const char* valve : {"size_10", "mine.toml"}) {
    const Answer answer = run(std::string("export fmu ") + valve + " -o valve.fmu");
    ASSERT_EQ(answer.status, 0) << answer.message;
    EXPECT_THAT(content("valve.fmu"), HasSubstr("binaries/win64/spoolflow_valve.dll"));
  }
  write("wrong.toml", "[plant.load]\nkind = \"balloon\"\n");
  const Answer missing = run("export fmu size_7 -o other.fmu");
  EXPECT_EQ(missing.status, 2);
  EXPECT_THAT(missing.message, HasSubstr("size_7: is no file and no valve of the virtual rig"));
  EXPECT_THAT(missing.message, HasSubstr("or one of size_6, size_10"));
  const Answer answer = run("export fmu wrong.toml -o other.fmu");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("wrong.toml"), HasSubstr("balloon")));
}

TEST_F(ExportFmu, SaysThatAModelWithoutObserverRunsTheCondensedSensor) {
  std::string text = content(model);
  const auto at = text.find("\"observer\"");
  ASSERT_NE(at, std::string::npos);
  write("condensed.json", text.replace(at, 10, "\"no_observer\""));
  const Answer answer = run("export fmu condensed.json -o sensor.fmu");
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("not calibrated for the observer"), HasSubstr("condensed sensor")));
}

TEST_F(ExportFmu, RefusesAPathThatCannotBeWrittenAndAModelThatIsNone) {
  Answer answer = run("export fmu '" + model + "' -o nowhere/sensor.fmu");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, HasSubstr("nowhere"));
  answer = run("export fmu '" + model + "' -o '" + model + "'");
  EXPECT_EQ(answer.status, 2);
  write("cut.json", content(model).substr(0, 5000));
  answer = run("export fmu cut.json -o sensor.fmu");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("cut.json, line "), HasSubstr("cut short")));
  EXPECT_THAT(files(), ::testing::ElementsAre("cut.json"));
}

}  // namespace
}  // namespace spoolflow::apps

/// `spoolflow export`: what it leaves in folders that hold something already, and what it refuses.
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class Export : public CommandLine {
 protected:
  const std::string model = SPOOLFLOW_EXAMPLE_MODEL;
};

TEST_F(Export, WritesAFolderWithExampleAndSelfTest) {
  const Answer answer = run("export cpp '" + model + "' -o new/valve");
  ASSERT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.message, IsEmpty());
  for (const char* file :
       {"README.md", "example.cpp", "self_test.cpp", "valve_model.hpp", "spoolflow/sensor/observer.hpp"}) {
    EXPECT_THAT(content(std::filesystem::path("new/valve") / file), Not(IsEmpty())) << file;
  }
}

TEST_F(Export, ReplacesAnEarlierExportAndLeavesTheRest) {
  ASSERT_EQ(run("export cpp '" + model + "' -o valve").status, 0);
  const std::string before = content("valve/valve_model.hpp");
  write("valve/notes.txt", "mine");
  std::filesystem::remove(folder / "valve/golden_points.hpp");
  ASSERT_EQ(run("export cpp '" + model + "' -o valve").status, 0);
  EXPECT_EQ(content("valve/valve_model.hpp"), before);
  EXPECT_EQ(content("valve/notes.txt"), "mine");
  EXPECT_THAT(content("valve/golden_points.hpp"), StartsWith("// Made by"));
}

TEST_F(Export, DoesNotMixTwoKindsInOneFolder) {
  std::filesystem::create_directory(folder / "valve");
  write("valve/exported.sha256", std::string(64, 'a') + "  libvalve_sensor.a\n");
  const Answer answer = run("export cpp '" + model + "' -o valve");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, HasSubstr("cannot export into valve: libvalve_sensor.a there is of an export of another "
                                        "kind, whose files have the same names; name another folder"));
  EXPECT_FALSE(std::filesystem::exists(folder / "valve/valve_model.hpp"));
}

TEST_F(Export, KeepsWhatWasChangedSinceTheLastExport) {
  ASSERT_EQ(run("export cpp '" + model + "' -o valve").status, 0);
  const std::string mine = content("valve/example.cpp") + "// mine\n";
  write("valve/example.cpp", mine);
  std::filesystem::remove(folder / "valve/golden_points.hpp");
  const Answer answer = run("export cpp '" + model + "' -o valve");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("valve/example.cpp"), HasSubstr("changed since it was exported")));
  EXPECT_EQ(content("valve/example.cpp"), mine);
  EXPECT_THAT(content("valve/golden_points.hpp"), IsEmpty());
}

TEST_F(Export, DoesNotTouchSomebodysFileOfTheSameName) {
  std::filesystem::create_directory(folder / "valve");
  write("valve/example.cpp", "int main() {}  // mine");
  const Answer answer = run("export cpp '" + model + "' -o valve");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("valve/example.cpp"), HasSubstr("another folder")));
  EXPECT_EQ(content("valve/example.cpp"), "int main() {}  // mine");
}

TEST_F(Export, RefusesWhatIsNoFolderAndWhatIsNoModel) {
  write("taken", "a file");
  Answer answer = run("export cpp '" + model + "' -o taken/valve");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, HasSubstr("taken"));
  answer = run("export cpp taken -o valve");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(files(), Not(Contains("valve")));
  EXPECT_EQ(run("export gold '" + model + "' -o valve").status, 2);
  EXPECT_EQ(run("export cpp '" + model + "' -o -").status, 2);
  EXPECT_EQ(content("taken"), "a file");
}

TEST_F(Export, TakesTheDirectionThatTheModelHasAndRefusesTheOther) {
  EXPECT_EQ(run("export cpp '" + model + "' --direction b -o valve").status, 0);
  for (const char* kind : {"cpp", "fmu", "parameters"}) {
    const Answer answer = run("export " + std::string(kind) + " '" + model + "' --direction a -o other");
    EXPECT_EQ(answer.status, 2);
    EXPECT_THAT(answer.message, AllOf(HasSubstr("--direction a"), HasSubstr("direction b alone")));
  }
  EXPECT_EQ(run("export fmu size_6 --direction a -o other").status, 2);
  EXPECT_THAT(files(), Not(Contains("other")));
}

TEST_F(Export, WritesParametersThatInspectReadsBackAndFindsDamageIn) {
  const std::string command = "export parameters '" + model + "' -o valve.bin";
  ASSERT_EQ(run(command).status, 0);
  Answer answer = run("inspect valve.bin");
  EXPECT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.output, AllOf(HasSubstr("direction b"), HasSubstr("observer, condensed, of one direction"),
                                   HasSubstr("as computed"), HasSubstr("The sensor takes it.")));
  EXPECT_THAT(run("inspect valve.bin --json").output, HasSubstr("\"accepted\": true"));
  std::string bytes = content("valve.bin");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write("worn.bin", bytes);
  answer = run("inspect worn.bin");
  EXPECT_EQ(answer.status, 2);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("worn.bin"), HasSubstr("CRC-32 does not hold")));
  EXPECT_EQ(run("inspect worn.bin --json").status, 2);
  EXPECT_LT(content("valve.bin").size(), 80000U);
  ASSERT_EQ(run(command + " --sensors observer").status, 0);
  EXPECT_LT(content("valve.bin").size(), 32768U);
  EXPECT_EQ(run("export cpp '" + model + "' --sensors observer -o other").status, 2);
  EXPECT_EQ(run("export cpp '" + model + "' --fmi 3 -o other").status, 2);
}

TEST_F(Export, ReportsThatAPageHoldsTheBeginningOfALongName) {
  std::string text = content(model);
  const std::string before = "\"name\": \"";
  const std::size_t at = text.find(before);
  ASSERT_NE(at, std::string::npos);
  text.insert(at + before.size(), std::string(63, 'L'));
  write("long.json", text);
  const Answer answer = run("export parameters long.json -o valve.bin");
  EXPECT_EQ(answer.status, 0);
  EXPECT_THAT(answer.message, AllOf(HasSubstr("room for 63 of the name's"), HasSubstr("model_sha256")));
  EXPECT_THAT(run("inspect valve.bin").output, HasSubstr(std::string(63, 'L') + ","));
}

TEST_F(Export, ReportsAPageThatWasNeverProgrammed) {
  for (const char bit : {'\xff', '\0'}) {
    write("page.rom", std::string(40000, bit));
    const Answer answer = run("inspect page.rom");
    EXPECT_EQ(answer.status, 2);
    EXPECT_THAT(answer.output, HasSubstr("an erased page"));
    EXPECT_LT(answer.output.size() + answer.message.size(), 1000U);
    EXPECT_EQ(run("inspect page.rom --json").status, 2);
  }
  write("other.bin", "GRBL, and no parameters");
  EXPECT_EQ(run("inspect other.bin").status, 2);
}

TEST_F(Export, RefusesADateThatIsNone) {
  for (const char* date : {"abc", "-5", "99999999999999"}) {
    ::setenv("SOURCE_DATE_EPOCH", date, 1);
    const Answer answer = run("export parameters '" + model + "' -o dated.bin");
    ::unsetenv("SOURCE_DATE_EPOCH");
    EXPECT_EQ(answer.status, 2) << date;
    EXPECT_THAT(answer.message, HasSubstr("SOURCE_DATE_EPOCH"));
    EXPECT_THAT(files(), Not(Contains("dated.bin")));
  }
}

}  // namespace
}  // namespace spoolflow::apps

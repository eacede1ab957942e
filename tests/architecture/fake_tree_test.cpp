/// The checks themselves: each must find its violation in a small made-up tree.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/architecture/file_rules.hpp"
#include "tests/architecture/floors.hpp"
#include "tests/architecture/folder_rules.hpp"
#include "tests/architecture/folder_table.hpp"
#include "tests/architecture/function_rules.hpp"
#include "tests/architecture/include_rules.hpp"
#include "tests/architecture/link_rules.hpp"

namespace spoolflow::architecture {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* page = R"(# Architecture
| folder (`spoolflow/…`) | what lives there | may include | libraries | never |
|---|---|---|---|---|
| `units` | conversions | std | - | anything else |
| `sensor` | the core | freestanding std | - | heap, any library |
| `recording` | files | units | fmt, POSIX | sensor |
| `rig` | the virtual rig | recording, units | fmt | sensor, model |
| `fits/lines` | straight fits | units | - | - |
| `fits/curves` | other fits | fits/lines, units | - | - |
| `tables` | what fits found | fits | - | - |
| `runs` | a running fit | units | - | - |
| `runs/files` | the same of files | runs, recording | - | - |
| `watch` | of a running fit | runs alone | - | - |
| `apps` | the command | all | fmt, CLI11 | - |
)";

class FakeTree : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "spoolflow-tree-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    root = name;
    write("ARCHITECTURE.md", page);
    write("spoolflow/units/conversion.hpp", "#pragma once\n#include <cmath>\n");
    write("spoolflow/sensor/table.hpp", "#pragma once\n#include <array>\n");
  }
  void TearDown() override { fs::remove_all(root); }

  void write(const fs::path& file, const std::string& text) const {
    fs::create_directories((root / file).parent_path());
    std::ofstream(root / file) << text;
  }
  [[nodiscard]] auto includes() const { return include_violations(table(), root); }
  [[nodiscard]] FolderTable table() const { return read_folder_table(root / "ARCHITECTURE.md"); }

  fs::path root;
};

TEST_F(FakeTree, PassesWhereEveryIncludeIsAllowed) {
  write("spoolflow/rig/oil.cpp",
        "#include <cmath>\n#include <fmt/format.h>\n#include \"spoolflow/units/conversion.hpp\"\n");
  write("spoolflow/apps/main.cpp", "#include <CLI/CLI.hpp>\n#include \"spoolflow/sensor/table.hpp\"\n");
  EXPECT_THAT(includes(), IsEmpty());
  EXPECT_THAT(file_violations(root), IsEmpty());
}

TEST_F(FakeTree, FindsARigThatKnowsTheSensor) {
  write("spoolflow/rig/oil.cpp", "\n#include \"spoolflow/sensor/table.hpp\"\n");
  EXPECT_THAT(includes(),
              ElementsAre("spoolflow/rig/oil.cpp:2: rig must not include sensor (spoolflow/sensor/table.hpp)"));
}

TEST_F(FakeTree, FindsALibraryWhereNoneIsAllowed) {
  write("spoolflow/units/text.cpp", "#include <fmt/format.h>\n");
  write("spoolflow/rig/options.cpp", "# include <CLI/CLI.hpp>\n");
  EXPECT_THAT(includes(), ElementsAre(HasSubstr("rig must not use CLI11"), HasSubstr("units must not use fmt")));
}

TEST_F(FakeTree, FindsAHeaderThatBareMetalLacks) {
  write("spoolflow/sensor/log.hpp", "#pragma once\n#include <string>\n");
  EXPECT_THAT(includes(),
              ElementsAre("spoolflow/sensor/log.hpp:2: sensor is freestanding and must not include <string>"));
}

TEST_F(FakeTree, FindsALibraryThatTheTableDoesNotKnow) {
  write("spoolflow/apps/plot.cpp", "#include <gnuplot/plot.h>\n");
  EXPECT_THAT(includes(), ElementsAre(HasSubstr("<gnuplot/plot.h> belongs to no library")));
}

TEST_F(FakeTree, FindsARelativeIncludeAndOneOfNothing) {
  write("spoolflow/rig/oil.cpp", "#include \"../sensor/table.hpp\"\n#include \"spoolflow/units/nothing.hpp\"\n");
  EXPECT_THAT(includes(), ElementsAre(HasSubstr("is no path from"), HasSubstr("is no path from")));
}

TEST_F(FakeTree, FindsAFolderOutsideTheTable) {
  write("spoolflow/extras/x.hpp", "#pragma once\n");
  EXPECT_THAT(includes(), ElementsAre(HasSubstr("the folder extras is not in the table")));
}

TEST_F(FakeTree, KnowsThePartsOfAFolder) {
  write("spoolflow/fits/lines/line.hpp", "#pragma once\n");
  write("spoolflow/fits/curves/curve.cpp", "#include \"spoolflow/fits/lines/line.hpp\"\n");
  write("spoolflow/tables/table.cpp", "#include \"spoolflow/fits/lines/line.hpp\"\n");
  EXPECT_THAT(includes(), IsEmpty());
  write("spoolflow/fits/curves/curve.hpp", "#pragma once\n");
  write("spoolflow/fits/lines/line.cpp", "#include \"spoolflow/fits/curves/curve.hpp\"\n");
  EXPECT_THAT(includes(), ElementsAre("spoolflow/fits/lines/line.cpp:1: fits/lines must not include fits/curves "
                                      "(spoolflow/fits/curves/curve.hpp)"));
}

TEST_F(FakeTree, KeepsAFolderThatIsMeantAloneFromItsParts) {
  write("spoolflow/runs/run.hpp", "#pragma once\n");
  write("spoolflow/runs/files/file_run.hpp", "#pragma once\n#include \"spoolflow/runs/run.hpp\"\n");
  write("spoolflow/watch/watch.hpp", "#pragma once\n#include \"spoolflow/runs/run.hpp\"\n");
  EXPECT_THAT(includes(), IsEmpty());
  EXPECT_EQ(floors(table()).at("watch"), 3);  // above runs, not above its part
  write("spoolflow/watch/watch.cpp", "#include \"spoolflow/runs/files/file_run.hpp\"\n");
  EXPECT_THAT(includes(), ElementsAre("spoolflow/watch/watch.cpp:1: watch must not include runs/files "
                                      "(spoolflow/runs/files/file_run.hpp)"));
}

TEST_F(FakeTree, FindsAPartOutsideTheTableAndAFileOutsideTheParts) {
  write("spoolflow/fits/planes/plane.hpp", "#pragma once\n");
  write("spoolflow/fits/all.hpp", "#pragma once\n");
  EXPECT_THAT(includes(), ElementsAre(HasSubstr("the folder fits is not in the table"),
                                      HasSubstr("the folder fits/planes is not in the table")));
}

TEST_F(FakeTree, TakesAFolderInsideOneWithoutPartsForItsOwn) {
  write("spoolflow/rig/pumps/pump.cpp", "#include \"spoolflow/sensor/table.hpp\"\n");
  EXPECT_THAT(includes(), ElementsAre(HasSubstr("rig must not include sensor")));
}

constexpr const char* linked_well =
    "spoolflow_sensor:\nspoolflow_recording: spoolflow_units fmt::fmt\nspoolflow_apps: spoolflow_rig\n"
    "spoolflow_fits_lines: spoolflow_units\nspoolflow_tables: spoolflow_fits_curves\nspoolflow_runs:\n"
    "spoolflow_runs_files: spoolflow_runs\nspoolflow_watch: spoolflow_runs\n";

TEST_F(FakeTree, StandsFloorByFloor) {
  const Floors standing = floors(table());
  EXPECT_EQ(standing.at("units"), 1);
  EXPECT_EQ(standing.at("recording"), 2);
  EXPECT_EQ(standing.at("fits/curves"), 3);
  EXPECT_EQ(standing.at("tables"), 4);  // above every part of fits
  EXPECT_EQ(standing.at("apps"), 5);    // above all
  write("ARCHITECTURE.md", std::string("```floors\n 2  rig\n    fits/lines\n 1  units\n```\n 3  no drawing\n") + page);
  EXPECT_EQ(drawn_floors(root / "ARCHITECTURE.md"), (Floors{{"rig", 2}, {"fits/lines", 2}, {"units", 1}}));
  write("ARCHITECTURE.md", page);
  EXPECT_THROW((void)drawn_floors(root / "ARCHITECTURE.md"), std::runtime_error);
}

TEST_F(FakeTree, FindsForbiddenLinks) {
  write("links", std::string(linked_well) +
                     "spoolflow_rig: spoolflow_settings spoolflow_units fmt::fmt spoolflow_sensor spoolflow_pumps\n"
                     "spoolflow_fits_curves: spoolflow_fits_lines spoolflow_tables\nspoolflow_units: CLI11::CLI11\n");
  EXPECT_THAT(link_violations(table(), root / "links"),
              ElementsAre("the target of rig must not link sensor",
                          "rig links spoolflow_pumps, which is no folder of the table",
                          "the target of fits/curves must not link tables", "the target of units must not link CLI11"));
}

TEST_F(FakeTree, FindsAFolderWithoutATargetAndATargetWithoutAFolder) {
  write("links", std::string(linked_well) + "spoolflow_rig:\nspoolflow_units:\nspoolflow_pumps:\n");
  EXPECT_THAT(link_violations(table(), root / "links"),
              ElementsAre("the target spoolflow_pumps has no folder in the table",
                          "the folder fits/curves has no target of its own"));
}

TEST_F(FakeTree, FindsAFolderThatIsTooFull) {
  for (std::size_t k = 0; k < most_subjects; ++k) {
    write("spoolflow/rig/part_" + std::to_string(k) + ".hpp", "#pragma once\n");
    write("spoolflow/rig/part_" + std::to_string(k) + ".cpp", "");  // of the same subject
  }
  write("spoolflow/rig/inner/part.hpp", "#pragma once\n");
  EXPECT_THAT(full_folders(root), IsEmpty());
  write("spoolflow/rig/one_more.cpp", "");
  EXPECT_THAT(full_folders(root), ElementsAre("spoolflow/rig holds 26 subjects; past 25 divide it"));
}

TEST_F(FakeTree, FindsSubjectsThatIncludeEachOther) {
  write("spoolflow/rig/pump.hpp", "#pragma once\n");
  write("spoolflow/rig/pump.cpp", "#include \"spoolflow/rig/pump.hpp\"\n#include \"spoolflow/rig/oil.hpp\"\n");
  write("spoolflow/rig/oil.hpp", "#pragma once\n");
  EXPECT_THAT(circles(root), IsEmpty());
  write("spoolflow/rig/oil.hpp", "#pragma once\n#include \"spoolflow/rig/pump.hpp\"\n");
  EXPECT_THAT(circles(root),
              ElementsAre("round in a circle: spoolflow/rig/oil -> spoolflow/rig/pump -> spoolflow/rig/oil"));
}

TEST_F(FakeTree, FindsAFileThatHasGrownTooLong) {
  write("spoolflow/rig/long.cpp", std::string(350, '\n'));
  EXPECT_THAT(file_violations(root), IsEmpty());
  write("spoolflow/rig/long.cpp", std::string(351, '\n'));
  EXPECT_THAT(file_violations(root), ElementsAre(HasSubstr("long.cpp: 351 lines")));
}

TEST_F(FakeTree, FindsAFunctionThatHasGrownTooLongWhereNoReasonIsGiven) {
  const auto lines = [](int count) {
    std::string body;
    for (int k = 0; k < count; ++k) body += "  work();\n";
    return body;
  };
  write("spoolflow/rig/short.cpp", "int short_one(int a,\n              int b) {\n" + lines(57) + "}\n");
  write("spoolflow/rig/inside.cpp",
        "struct Oil {\n" + lines(70) + "};\n\nnamespace {\n" + lines(70) + "}  // namespace\n");
  EXPECT_THAT(function_violations(root), IsEmpty());
  write("spoolflow/rig/long.cpp", "// long: a table\nint table(int a) {\n" + lines(70) +
                                      "}\n\nint long_one(int a,\n             int b) {\n" + lines(58) + "}\n");
  write("spoolflow/rig/method.hpp",
        "#pragma once\nclass Oil {\n public:\n  int method() {\n" + lines(59) + "  }\n};\n");
  EXPECT_THAT(function_violations(root), ElementsAre(HasSubstr("long.cpp:75: a function of 61 lines"),
                                                     HasSubstr("method.hpp:4: a function of 61 lines")));
}

TEST_F(FakeTree, FindsNamesThatSayNothing) {
  write("spoolflow/rig/string_utils.cpp", "");
  write("tests/common/x.cpp", "");
  EXPECT_THAT(file_violations(root), ElementsAre(HasSubstr("string_utils"), HasSubstr("common")));
}

TEST_F(FakeTree, FindsAHeaderThatCanBeReadTwice) {
  write("spoolflow/rig/oil.hpp", "struct Oil;\n");
  EXPECT_THAT(file_violations(root), ElementsAre("spoolflow/rig/oil.hpp: no #pragma once"));
}

TEST_F(FakeTree, FindsOutputsOpenedOutsideApps) {
  write("spoolflow/rig/oil.cpp", "std::ofstream out(name);\n");
  write("spoolflow/apps/output.cpp", "std::ofstream out(name);\n");
  EXPECT_THAT(file_violations(root), ElementsAre("spoolflow/rig/oil.cpp:1: only apps opens output files"));
}

TEST_F(FakeTree, FindsExtensionsOfCompilersInTheSensor) {
  const std::string extension = "[[gnu::noinline]] int f();\n";
  write("spoolflow/sensor/basis/compiler.hpp", "#pragma once\n" + extension);
  write("spoolflow/rig/oil.cpp", extension);
  EXPECT_THAT(file_violations(root), IsEmpty());
  write("spoolflow/sensor/edge.hpp", "#pragma once\n" + extension);
  EXPECT_THAT(file_violations(root),
              ElementsAre("spoolflow/sensor/edge.hpp:2: extensions of compilers stand in sensor/basis/compiler.hpp"));
}

TEST_F(FakeTree, FindsUnfinishedWork) {
  write("spoolflow/rig/oil.cpp",
        "// TO"
        "DO: density\n");
  EXPECT_THAT(file_violations(root), ElementsAre("spoolflow/rig/oil.cpp:1: unfinished work"));
}

TEST_F(FakeTree, RefusesATableThatContradictsItself) {
  const std::string head = "| folder | what | may include | libraries | never |\n|---|---|---|---|---|\n";
  write("ARCHITECTURE.md", head + "| `units` | x | std | - | - |\n| `rig` | x | units | - | units |\n");
  EXPECT_THROW((void)table(), std::runtime_error);
  write("ARCHITECTURE.md", head + "| `rig` | x | unitz | - | - |\n");
  EXPECT_THROW((void)table(), std::runtime_error);
  write("ARCHITECTURE.md", head + "| `rig` | x | units | - | - |\n| `units` | x | rig | - | - |\n");
  EXPECT_THROW((void)table(), std::runtime_error);
  write("ARCHITECTURE.md", "no table\n");
  EXPECT_THROW((void)table(), std::runtime_error);
}

}  // namespace
}  // namespace spoolflow::architecture

/// The project itself against its own rules. SPOOLFLOW_ROOT and SPOOLFLOW_LINKS come from CMake.
#include <filesystem>
#include <string>
#include <vector>

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

using ::testing::IsEmpty;

const std::filesystem::path project_root = SPOOLFLOW_ROOT;

FolderTable table() {
  return read_folder_table(project_root / "docs" / "ARCHITECTURE.md");
}

TEST(ThisProject, IncludesOnlyWhatItsTableAllows) {
  EXPECT_THAT(include_violations(table(), project_root), IsEmpty());
}

TEST(ThisProject, LinksOnlyWhatItsTableAllows) {
  EXPECT_THAT(link_violations(table(), SPOOLFLOW_LINKS), IsEmpty());
}

TEST(ThisProject, StandsAsItIsDrawn) {
  EXPECT_EQ(drawn_floors(project_root / "docs" / "ARCHITECTURE.md"), floors(table()));
}

TEST(ThisProject, KeepsItsFilesShortAndNamedByWhatTheyHold) {
  EXPECT_THAT(file_violations(project_root), IsEmpty());
}

TEST(ThisProject, KeepsItsFunctionsShort) {
  EXPECT_THAT(function_violations(project_root), IsEmpty());
}

TEST(ThisProject, KeepsItsFoldersSmallEnoughToBeTakenIn) {
  EXPECT_THAT(full_folders(project_root), IsEmpty());
}

TEST(ThisProject, HasNoSubjectsThatIncludeEachOther) {
  EXPECT_THAT(circles(project_root), IsEmpty());
}

}  // namespace
}  // namespace spoolflow::architecture

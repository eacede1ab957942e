/// A build that reads no Excel workbooks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/recording/open_table.hpp"
#include "tests/recording/refusal.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::recording {
namespace {

TEST(XlsxAbsent, SaysThatThisBuildDoesNotReadWorkbooksAndWhatToDo) {
  const TemporaryFile file("run.xlsx", "PK\x03\x04 and more");
  EXPECT_THAT(refusal([&] { (void)open_sample_table(file.path()); }),
              ::testing::HasSubstr("which this build of spoolflow does not read; save the sheet as CSV"));
}

}  // namespace
}  // namespace spoolflow::recording

#include "spoolflow/recording/channels/nearest_name.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace spoolflow::recording {
namespace {

TEST(NearestName, CountsInsertedDeletedReplacedAndSwappedLettersAsOneStep) {
  EXPECT_EQ(edit_distance("inspect", "inspect"), 0u);
  EXPECT_EQ(edit_distance("inspct", "inspect"), 1u);
  EXPECT_EQ(edit_distance("inspeect", "inspect"), 1u);
  EXPECT_EQ(edit_distance("inspekt", "inspect"), 1u);
  EXPECT_EQ(edit_distance("inpsect", "inspect"), 1u);
  EXPECT_EQ(edit_distance("", "inspect"), 7u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(NearestName, IsTheFirstOfThoseFewestStepsAway) {
  const std::vector<std::string> known{"position", "pressure", "force"};
  EXPECT_EQ(nearest_name("presure", known), "pressure");
  EXPECT_EQ(nearest_name("forces", known), "force");
  EXPECT_EQ(nearest_name("", std::vector<std::string>{"ab", "cd"}), "ab");
}

}  // namespace
}  // namespace spoolflow::recording

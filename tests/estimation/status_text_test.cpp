#include "spoolflow/estimation/status_text.hpp"

#include <gtest/gtest.h>

namespace spoolflow::estimation {
namespace {

using sensor::Status;

TEST(StatusText, JoinsTheNamesOfTheSetBits) {
  StatusText text;
  EXPECT_EQ(text(Status::none), "");
  EXPECT_EQ(text(Status::closed), "closed");
  EXPECT_EQ(text(Status::closed | Status::sample_missing), "closed|sample_missing");
  EXPECT_EQ(text(Status::closed), "closed");
  EXPECT_EQ(text(Status::closed | Status::model_doubt), "closed|model_doubt");
}

}  // namespace
}  // namespace spoolflow::estimation

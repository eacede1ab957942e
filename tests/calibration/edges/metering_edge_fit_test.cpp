#include "spoolflow/calibration/edges/metering_edge_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace spoolflow::calibration {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

recording::Recording map_at(const std::string& file, double oil_K) {
  recording::Recording out;
  out.file = file;
  out.column(recording::Channel::oil_temperature) = {oil_K, oil_K};
  return out;
}

TEST(MapsLeftAside, AreThoseOfOilThatAnotherHasAndOfOilThatNobodyMeasured) {
  const recording::Recording cold = map_at("cold.csv", 303), warm = map_at("warm.csv", 323.15),
                             again = map_at("again.csv", 323.65);
  recording::Recording bare = map_at("bare.csv", 0);
  bare.column(recording::Channel::oil_temperature).clear();
  EXPECT_THAT(maps_left_aside({&cold, &warm}), IsEmpty());
  EXPECT_THAT(maps_left_aside({&bare}), IsEmpty());
  EXPECT_THAT(maps_left_aside({&warm, &cold, &again}),
              ElementsAre(HasSubstr("warm.csv and again.csv are both of oil at 50.5 degC")));
  EXPECT_THAT(maps_left_aside({&cold, &bare}), ElementsAre(HasSubstr("cold.csv and bare.csv: no oil temperature")));
}

}  // namespace
}  // namespace spoolflow::calibration

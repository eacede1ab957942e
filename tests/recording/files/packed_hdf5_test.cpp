/// HDF5 datasets stored as integers with a scale, as examples/ has them.
#include <gtest/gtest.h>

#include "spoolflow/recording/reader.hpp"

namespace spoolflow::recording {
namespace {

TEST(PackedHdf5, IsUnpackedByItsScaleFactor) {
  const Recording spring = read_recording(SPOOLFLOW_EXAMPLES "/valve_a/spring.h5",
                                          {.channels = {},
                                           .required = {Channel::time, Channel::position, Channel::axial_force},
                                           .optional = {Channel::oil_temperature},
                                           .stroke_m = {}});
  ASSERT_GT(spring.size(), 2000U);
  EXPECT_DOUBLE_EQ(spring[Channel::time][0], 0.0);
  EXPECT_NEAR(spring[Channel::time][1], 0.02, 1e-12);
  EXPECT_NEAR(spring[Channel::oil_temperature][0], 273.15 + 24.98, 1e-9);  // as the recording was packed from
  EXPECT_NEAR(spring[Channel::axial_force][0], 9.05, 1e-9);
  EXPECT_NEAR(spring[Channel::position][0], -4.5e-6, 1e-12);  // -4.48 um, rounded to 0.1 um
}

}  // namespace
}  // namespace spoolflow::recording

/// What numbers are compared by, in both precisions: their bits where the compiler has them, or their values.
#include "spoolflow/sensor/basis/scalar.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace spoolflow::sensor {
namespace {

template <class T>
class Scalar : public testing::Test {
 protected:
  static constexpr T nan = std::numeric_limits<T>::quiet_NaN();
  static constexpr T infinity = std::numeric_limits<T>::infinity();
  static constexpr T smallest = std::numeric_limits<T>::denorm_min();
};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(Scalar, Precisions);

TYPED_TEST(Scalar, LiesWithinFromZeroUpToTheLimitAlone) {
  using T = TypeParam;
  const T below = std::nextafter(T(2), T(0));
  for (const T inside : {T(0), this->smallest, T(1), below}) EXPECT_TRUE(within(inside, T(2))) << inside;
  for (const T outside : {-this->smallest, T(-1), T(2), this->infinity, -this->infinity, this->nan, -this->nan})
    EXPECT_FALSE(within(outside, T(2))) << outside;
}

TYPED_TEST(Scalar, IsANumberUnlessNoValveHasIt) {
  using T = TypeParam;
  for (const T number : {T(0), T(-0.0), this->smallest, T(-1), std::nextafter(T(1 << 30), T(0))}) {
    EXPECT_TRUE(is_number(number)) << number;
    EXPECT_TRUE(is_number(-number)) << -number;
  }
  for (const T none : {T(1 << 30), this->infinity, this->nan}) {
    EXPECT_FALSE(is_number(none)) << none;
    EXPECT_FALSE(is_number(-none)) << -none;
  }
}

TYPED_TEST(Scalar, IsZeroOfEitherSignAndNothingElse) {
  using T = TypeParam;
  EXPECT_TRUE(is_zero(T(0)));
  EXPECT_TRUE(is_zero(T(-0.0)));
  for (const T other : {this->smallest, -this->smallest, T(1), this->infinity, this->nan, -this->nan})
    EXPECT_FALSE(is_zero(other)) << other;
}

TYPED_TEST(Scalar, NanLiesBelowAndAboveNothing) {
  using T = TypeParam;
  EXPECT_TRUE(lies_below(T(1), T(2)));
  EXPECT_FALSE(lies_below(T(2), T(2)));
  EXPECT_FALSE(lies_below(this->nan, T(2)));
  EXPECT_TRUE(lies_above(T(-1), T(-2)));
  EXPECT_FALSE(lies_above(T(-2), T(-2)));
  EXPECT_FALSE(lies_above(-this->nan, T(-2)));
}

}  // namespace
}  // namespace spoolflow::sensor

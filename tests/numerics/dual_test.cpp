#include "spoolflow/numerics/dual.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "spoolflow/sensor/basis/scalar.hpp"

namespace spoolflow::numerics {
namespace {

/// Every operation that the sensor asks of its scalar.
template <class T>
T formula(const T& x, const T& y) {
  using std::sqrt;
  T out = x * y / (T(1) + x * x) - sqrt(y) + sensor::magnitude(x - y) * sensor::limited(y, T(0), T(3));
  out += sensor::larger(x, y);
  out -= -x;
  return out;
}

TEST(Dual, SlopesAreThoseOfDifferences) {
  constexpr double h = 1e-6;
  for (const double x : {0.2, 1.7, 4.0}) {
    for (const double y : {0.5, 2.5, 3.5}) {
      Dual<2> dual_x(x), dual_y(y);
      dual_x.slope[0] = dual_y.slope[1] = 1;
      const Dual<2> out = formula(dual_x, dual_y);
      EXPECT_EQ(out.value, formula(x, y));
      EXPECT_NEAR(out.slope[0], (formula(x + h, y) - formula(x - h, y)) / (2 * h), 1e-8) << x << ' ' << y;
      EXPECT_NEAR(out.slope[1], (formula(x, y + h) - formula(x, y - h)) / (2 * h), 1e-8) << x << ' ' << y;
    }
  }
}

TEST(Dual, TheRootOfZeroHasNoSlope) {
  Dual<1> zero(0);
  zero.slope[0] = 1;
  EXPECT_EQ(sqrt(zero).slope[0], 0);
}

}  // namespace
}  // namespace spoolflow::numerics

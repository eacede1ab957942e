#pragma once
/// The elementary functions of several valves at once, bit by bit those of elementary_functions.hpp.
#include "spoolflow/rig/numerics/elementary_functions.hpp"
#include "spoolflow/rig/numerics/lanes.hpp"

namespace spoolflow::rig {

namespace elementary {

/// Added to a whole number below 2^51, it leaves that number in the lowest bits.
inline constexpr double whole_in_lowest_bits = 0x1.8p52;

}  // namespace elementary

template <int count>
Lanes<count> exponential(const Lanes<count>& x) {
  using Numbers = typename Lanes<count>::Numbers;
  using Bits = typename Lanes<count>::Bits;
  constexpr double per_ln_2 = 1.4426950408889634;
  const LaneMask<count> inside = magnitude(x) <= 700.0;
  const Lanes<count> within = select(inside, x, Lanes<count>(0.0));
  const Lanes<count> k = nearest_whole(within * per_ln_2);
  const Lanes<count> r = (within - k * elementary::ln_2_high) - k * elementary::ln_2_low;
  const Lanes<count> series = elementary::polynomial(elementary::exponential_series, r);
  const Bits whole = std::bit_cast<Bits>(k.numbers + elementary::whole_in_lowest_bits) -
                     std::bit_cast<std::int64_t>(elementary::whole_in_lowest_bits);
  const Lanes<count> power_of_two(std::bit_cast<Numbers>((whole + 1023) << 52));
  return select(inside, series * power_of_two, select(x < 0.0, Lanes<count>(0.0), x + HUGE_VAL));
}

/// Of normal numbers > 0.
template <int count>
Lanes<count> natural_logarithm(const Lanes<count>& x) {
  using Numbers = typename Lanes<count>::Numbers;
  using Bits = typename Lanes<count>::Bits;
  const Bits bits = std::bit_cast<Bits>(x.numbers);
  const Bits exponent = (bits >> 52) - 1022;
  Lanes<count> m(std::bit_cast<Numbers>((bits & 0x000fffffffffffff) | 0x3fe0000000000000));  // 1/2 <= m < 1
  Lanes<count> whole(std::bit_cast<Numbers>(exponent + std::bit_cast<std::int64_t>(elementary::whole_in_lowest_bits)) -
                     elementary::whole_in_lowest_bits);
  const LaneMask<count> small = m < 0.70710678118654752;
  m = select(small, m * 2.0, m);
  whole = select(small, whole - 1.0, whole);
  const Lanes<count> s = (m - 1.0) / (m + 1.0);
  const Lanes<count> series = elementary::polynomial(elementary::artanh_series, s * s);
  return whole * elementary::ln_2_high + (2.0 * s * series + whole * elementary::ln_2_low);
}

template <int count>
Lanes<count> power(const Lanes<count>& x, const Lanes<count>& y) {
  return exponential(y * natural_logarithm(x));
}

}  // namespace spoolflow::rig

#pragma once
/// Numbers of several valves side by side in one SIMD register, for the plant's templates. Types carry the number of
/// lanes, so that translation units for different instruction sets share none.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#if defined(__AVX__)
#include <experimental/simd>  // for the registers' own instructions
#endif

#include "spoolflow/rig/numerics/scalar.hpp"

namespace spoolflow::rig {

/// The compiler's own vectors.
template <int count>
struct Registers {
  using Numbers [[gnu::vector_size(count * sizeof(double))]] = double;
  using Bits [[gnu::vector_size(count * sizeof(double))]] = std::int64_t;
};

/// The answers of a comparison: all bits set where it holds, none where not.
template <int count>
struct LaneMask {
  using Bits = typename Registers<count>::Bits;
  Bits bits;

  LaneMask() = default;
  LaneMask(const Bits& all_lanes) : bits(all_lanes) {}
  LaneMask(bool value) : bits(Bits{} - (value ? 1 : 0)) {}
  [[nodiscard]] bool operator[](std::size_t lane) const { return bits[lane] != 0; }
  friend LaneMask operator!(const LaneMask& a) { return LaneMask(~a.bits); }
  friend LaneMask operator&&(const LaneMask& a, const LaneMask& b) { return LaneMask(a.bits & b.bits); }
  friend LaneMask operator||(const LaneMask& a, const LaneMask& b) { return LaneMask(a.bits | b.bits); }
};

template <int count>
struct Lanes {
  static constexpr std::size_t valves = count;
  using Numbers = typename Registers<count>::Numbers;
  using Bits = typename Registers<count>::Bits;
  Numbers numbers;

  Lanes() = default;
  Lanes(const Numbers& all_lanes) : numbers(all_lanes) {}
  Lanes(double value) : numbers(Numbers{} + value) {}
  [[nodiscard]] double operator[](std::size_t lane) const { return numbers[lane]; }
  void set(std::size_t lane, double value) { numbers[lane] = value; }

  friend Lanes operator-(const Lanes& a) { return Lanes(-a.numbers); }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.numbers + b.numbers); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.numbers - b.numbers); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.numbers * b.numbers); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.numbers / b.numbers); }
  Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  Lanes& operator-=(const Lanes& b) { return *this = *this - b; }
  Lanes& operator*=(const Lanes& b) { return *this = *this * b; }
  friend LaneMask<count> operator<(const Lanes& a, const Lanes& b) { return LaneMask<count>(a.numbers < b.numbers); }
  friend LaneMask<count> operator<=(const Lanes& a, const Lanes& b) { return LaneMask<count>(a.numbers <= b.numbers); }
  friend LaneMask<count> operator>(const Lanes& a, const Lanes& b) { return LaneMask<count>(a.numbers > b.numbers); }
  friend LaneMask<count> operator>=(const Lanes& a, const Lanes& b) { return LaneMask<count>(a.numbers >= b.numbers); }
  friend LaneMask<count> operator==(const Lanes& a, const Lanes& b) { return LaneMask<count>(a.numbers == b.numbers); }
  friend LaneMask<count> operator!=(const Lanes& a, const Lanes& b) { return LaneMask<count>(a.numbers != b.numbers); }
};

template <int count>
struct ScalarTypes<Lanes<count>> {
  using Mask = LaneMask<count>;
};

/// Whether it holds for one valve at least.
template <int count>
bool any(const LaneMask<count>& mask) {
#if defined(__AVX__)
  if constexpr (count == 4) return _mm256_movemask_pd(std::bit_cast<__m256d>(mask.bits)) != 0;
#endif
  std::int64_t joined = 0;
  for (std::size_t lane = 0; lane < count; ++lane) joined |= mask.bits[lane];
  return joined != 0;
}
template <int count>
bool all(const LaneMask<count>& mask) {
  return !any(!mask);
}

template <int count>
Lanes<count> select(const LaneMask<count>& condition, const Lanes<count>& yes, const Lanes<count>& no) {
  return Lanes<count>(condition.bits ? yes.numbers : no.numbers);
}
template <int count>
Lanes<count> select(const LaneMask<count>& condition, const Lanes<count>& yes, double no) {
  return select(condition, yes, Lanes<count>(no));
}
template <int count>
Lanes<count> select(const LaneMask<count>& condition, double yes, const Lanes<count>& no) {
  return select(condition, Lanes<count>(yes), no);
}

/// Of aggregates that hold lanes and nothing else.
template <int count, class Aggregate>
Aggregate blended(const LaneMask<count>& condition, const Aggregate& yes, const Aggregate& no) {
  using Numbers = typename Lanes<count>::Numbers;
  static_assert(sizeof(Aggregate) % sizeof(Numbers) == 0 && std::is_trivially_copyable_v<Aggregate>);
  Aggregate out;
  const auto blend = [&](std::size_t k) __attribute__((always_inline)) {
    Numbers a, b;
    std::memcpy(&a, reinterpret_cast<const char*>(&yes) + k * sizeof a, sizeof a);
    std::memcpy(&b, reinterpret_cast<const char*>(&no) + k * sizeof b, sizeof b);
    a = condition.bits ? a : b;
    std::memcpy(reinterpret_cast<char*>(&out) + k * sizeof a, &a, sizeof a);
  };
  [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
    (blend(k), ...);  // one by one in the source: the compiler keeps the members in registers
  }
  (std::make_index_sequence<sizeof(Aggregate) / sizeof(Numbers)>());
  return out;
}

template <int count, class Aggregate>
void take(const LaneMask<count>& taken, Aggregate& to, const Given<Aggregate>& value) {
  to = blended(taken, value, to);
}

template <int count>
Lanes<count> magnitude(const Lanes<count>& x) {
  using Bits = typename Lanes<count>::Bits;
  const Bits all_but_sign = Bits{} + INT64_MAX;
  return Lanes<count>(std::bit_cast<typename Lanes<count>::Numbers>(std::bit_cast<Bits>(x.numbers) & all_but_sign));
}

template <int count>
Lanes<count> square_root(const Lanes<count>& x) {
  using Numbers = typename Lanes<count>::Numbers;
#if defined(__AVX__)
  if constexpr (count == 4)
    return Lanes<count>(std::bit_cast<Numbers>(_mm256_sqrt_pd(std::bit_cast<__m256d>(x.numbers))));
#endif
  Numbers out{};
  for (std::size_t lane = 0; lane < count; ++lane) out[lane] = __builtin_sqrt(x.numbers[lane]);
  return Lanes<count>(out);
}

/// Ties to even; of numbers below 2^51.
template <int count>
Lanes<count> nearest_whole(const Lanes<count>& x) {
  using Numbers = typename Lanes<count>::Numbers;
  const Numbers carry = Numbers{} + 0x1.8p52;
  return Lanes<count>((x.numbers + carry) - carry);
}

template <int count>
Lanes<count> larger(const Lanes<count>& a, const Lanes<count>& b) {
  return select(a < b, b, a);
}
template <int count>
Lanes<count> smaller(const Lanes<count>& a, const Lanes<count>& b) {
  return select(b < a, b, a);
}
template <int count>
Lanes<count> larger(double a, const Lanes<count>& b) {
  return larger(Lanes<count>(a), b);
}
template <int count>
Lanes<count> larger(const Lanes<count>& a, double b) {
  return larger(a, Lanes<count>(b));
}
template <int count>
Lanes<count> smaller(const Lanes<count>& a, double b) {
  return smaller(a, Lanes<count>(b));
}
template <int count>
Lanes<count> clamped(const Lanes<count>& x, const Lanes<count>& least, const Lanes<count>& most) {
  return select(x < least, least, select(most < x, most, x));
}

}  // namespace spoolflow::rig

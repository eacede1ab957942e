#pragma once
/// SIMD registers of float or double: what x86 does in one instruction and std::experimental::simd does not, or answers
/// otherwise on AVX-512. Types carry the register, so that translation units for different instruction sets share none.
#include <bit>
#include <cstdint>
#include <experimental/simd>
#include <limits>
#include <type_traits>

namespace spoolflow::estimation::packs {

namespace simd = std::experimental;

/// A register in the compiler's own terms: comparisons answer in whole lanes on every instruction set.
template <class Register>
struct Plain {
  using Number = typename Register::value_type;
  using Integer = std::conditional_t<sizeof(Number) == sizeof(std::int32_t), std::int32_t, std::int64_t>;
  using Integers = simd::rebind_simd_t<Integer, Register>;
  using Numbers [[gnu::vector_size(sizeof(Register))]] = Number;
  using Bits [[gnu::vector_size(sizeof(Register))]] = Integer;

  [[gnu::always_inline]] static Numbers of(const Register& numbers) { return std::bit_cast<Numbers>(numbers); }
  [[gnu::always_inline]] static Bits of(const Integers& integers) { return std::bit_cast<Bits>(integers); }
};

/// Of which kind a register is.
template <class Register, class Number, std::size_t bytes>
inline constexpr bool is_register = std::is_same_v<typename Register::value_type, Number> && sizeof(Register) == bytes;

/// Floats of AVX-512 are compared into bits of a mask register.
template <class Register>
inline constexpr bool compares_to_bits = std::is_same_v<typename Register::value_type, float> &&
                                         sizeof(typename Register::mask_type) < sizeof(Register) / 8;

/// The answers of a comparison: a bit a valve, or a whole number of which all bits are set or none.
template <class Register>
using Answers = std::conditional_t<!compares_to_bits<Register>, typename Plain<Register>::Integers,
                                   std::conditional_t<Register::size() == 16, std::uint16_t, std::uint8_t>>;

template <class Register>
[[gnu::always_inline]] inline Answers<Register> answers(bool all) {
  if constexpr (compares_to_bits<Register>) {
    return static_cast<Answers<Register>>(all ? -1 : 0);
  } else {
    return Answers<Register>(typename Plain<Register>::Integer{all ? -1 : 0});
  }
}
template <class Bits>
[[gnu::always_inline]] inline Bits negated(const Bits& answers) {
  return static_cast<Bits>(~answers);
}

/// As the processor counts them.
enum class Relation : std::uint8_t { equal, less, less_or_equal };

/// Numbers of any kind in the compiler's own terms.
template <Relation relation, class Numbers>
[[gnu::always_inline]] inline auto related(const Numbers& a, const Numbers& b) {
  if constexpr (relation == Relation::equal) {
    return a == b;
  } else if constexpr (relation == Relation::less) {
    return a < b;
  } else {
    return a <= b;
  }
}
template <Relation relation, class Register>
[[gnu::always_inline]] inline Answers<Register> compared(const Register& a, const Register& b) {
#if defined(__AVX512VL__)
  if constexpr (compares_to_bits<Register> && Register::size() == 16)
    return _mm512_cmp_ps_mask(std::bit_cast<__m512>(a), std::bit_cast<__m512>(b), static_cast<int>(relation));
  else if constexpr (compares_to_bits<Register>)
    return _mm256_cmp_ps_mask(std::bit_cast<__m256>(a), std::bit_cast<__m256>(b), static_cast<int>(relation));
  else
#endif
    return std::bit_cast<Answers<Register>>(related<relation>(Plain<Register>::of(a), Plain<Register>::of(b)));
}
template <Relation relation, class Register>
[[gnu::always_inline]] inline Answers<Register> compared_integers(const typename Plain<Register>::Integers& a,
                                                                  const typename Plain<Register>::Integers& b) {
#if defined(__AVX512VL__)
  if constexpr (compares_to_bits<Register> && Register::size() == 16)
    return _mm512_cmp_epi32_mask(std::bit_cast<__m512i>(a), std::bit_cast<__m512i>(b), static_cast<int>(relation));
  else if constexpr (compares_to_bits<Register>)
    return _mm256_cmp_epi32_mask(std::bit_cast<__m256i>(a), std::bit_cast<__m256i>(b), static_cast<int>(relation));
  else
#endif
    return std::bit_cast<Answers<Register>>(related<relation>(Plain<Register>::of(a), Plain<Register>::of(b)));
}

/// Whether it holds for a valve at least.
template <class Register>
[[gnu::always_inline]] inline bool any_lane(const Answers<Register>& lanes) {
  if constexpr (compares_to_bits<Register>) {
    return lanes != 0;
  } else {
#if defined(__AVX512DQ__)
    if constexpr (is_register<Register, double, 64>) return _mm512_movepi64_mask(std::bit_cast<__m512i>(lanes)) != 0;
#endif
    if constexpr (sizeof(typename Register::mask_type) == sizeof lanes)
      return any_of(std::bit_cast<typename Register::mask_type>(lanes));
  }
}

/// `yes` where `condition` holds, else `no`.
template <class Register>
[[gnu::always_inline]] inline Register blended(const Answers<Register>& condition, const Register& yes,
                                               const Register& no) {
#if defined(__AVX512VL__)
  if constexpr (compares_to_bits<Register> && Register::size() == 16)
    return std::bit_cast<Register>(
        _mm512_mask_blend_ps(condition, std::bit_cast<__m512>(no), std::bit_cast<__m512>(yes)));
  else if constexpr (compares_to_bits<Register>)
    return std::bit_cast<Register>(
        _mm256_mask_blend_ps(condition, std::bit_cast<__m256>(no), std::bit_cast<__m256>(yes)));
  else
#endif
  {
    using In = Plain<Register>;
    return std::bit_cast<Register>(In::of(condition) ? In::of(yes) : In::of(no));
  }
}
/// The same of whole numbers.
template <class Register, class Integers = typename Plain<Register>::Integers>
[[gnu::always_inline]] inline Integers blended_integers(const Answers<Register>& condition, const Integers& yes,
                                                        const Integers& no) {
  if constexpr (compares_to_bits<Register>) {
    return std::bit_cast<Integers>(
        blended<Register>(condition, std::bit_cast<Register>(yes), std::bit_cast<Register>(no)));
  } else {
    return (yes & condition) | (no & ~condition);
  }
}

/// The same of masks that lie in the memory of a register.
template <class Register>
[[gnu::always_inline]] inline Register blended_masks(const Answers<Register>& condition, const Register& yes,
                                                     const Register& no) {
  if constexpr (compares_to_bits<Register>) {
    using Bits = typename Plain<Register>::Bits;
    constexpr std::uint32_t once_each = Register::size() == 16 ? 0x10001U : 0x1010101U;  // as many as 32 bits hold
    const Bits taken = Bits{} + static_cast<std::int32_t>(condition * once_each);
    return std::bit_cast<Register>((std::bit_cast<Bits>(yes) & taken) | (std::bit_cast<Bits>(no) & ~taken));
  } else {
    return blended<Register>(condition, yes, no);
  }
}

/// `integers` where `condition` holds, else 0.
template <class Register, class Integers = typename Plain<Register>::Integers>
[[gnu::always_inline]] inline Integers only(const Answers<Register>& condition, const Integers& integers) {
#if defined(__AVX512VL__)
  if constexpr (compares_to_bits<Register> && Register::size() == 16)
    return std::bit_cast<Integers>(_mm512_maskz_mov_epi32(condition, std::bit_cast<__m512i>(integers)));
  else if constexpr (compares_to_bits<Register>)
    return std::bit_cast<Integers>(_mm256_maskz_mov_epi32(condition, std::bit_cast<__m256i>(integers)));
  else
#endif
    return condition & integers;
}

/// `a < b ? a : b` and `a > b ? a : b`. The library's own would be a call, x86 has an instruction for just that.
template <class Register>
[[gnu::always_inline]] inline Register lesser(const Register& a, const Register& b) {
#if defined(__AVX512F__)
  if constexpr (is_register<Register, double, 64>)
    return std::bit_cast<Register>(_mm512_maskz_min_pd(0xff, std::bit_cast<__m512d>(a), std::bit_cast<__m512d>(b)));
  if constexpr (is_register<Register, float, 64>)
    return std::bit_cast<Register>(_mm512_maskz_min_ps(0xffff, std::bit_cast<__m512>(a), std::bit_cast<__m512>(b)));
#endif
#if defined(__AVX__)
  if constexpr (is_register<Register, double, 32>)
    return std::bit_cast<Register>(_mm256_min_pd(std::bit_cast<__m256d>(a), std::bit_cast<__m256d>(b)));
  if constexpr (is_register<Register, float, 32>)
    return std::bit_cast<Register>(_mm256_min_ps(std::bit_cast<__m256>(a), std::bit_cast<__m256>(b)));
#elif defined(__SSE__)
  if constexpr (is_register<Register, float, 16>)
    return std::bit_cast<Register>(_mm_min_ps(std::bit_cast<__m128>(a), std::bit_cast<__m128>(b)));
#endif
  using In = Plain<Register>;
  return std::bit_cast<Register>(In::of(a) < In::of(b) ? In::of(a) : In::of(b));
}
template <class Register>
[[gnu::always_inline]] inline Register greater(const Register& a, const Register& b) {
#if defined(__AVX512F__)
  if constexpr (is_register<Register, double, 64>)
    return std::bit_cast<Register>(_mm512_maskz_max_pd(0xff, std::bit_cast<__m512d>(a), std::bit_cast<__m512d>(b)));
  if constexpr (is_register<Register, float, 64>)
    return std::bit_cast<Register>(_mm512_maskz_max_ps(0xffff, std::bit_cast<__m512>(a), std::bit_cast<__m512>(b)));
#endif
#if defined(__AVX__)
  if constexpr (is_register<Register, double, 32>)
    return std::bit_cast<Register>(_mm256_max_pd(std::bit_cast<__m256d>(a), std::bit_cast<__m256d>(b)));
  if constexpr (is_register<Register, float, 32>)
    return std::bit_cast<Register>(_mm256_max_ps(std::bit_cast<__m256>(a), std::bit_cast<__m256>(b)));
#elif defined(__SSE__)
  if constexpr (is_register<Register, float, 16>)
    return std::bit_cast<Register>(_mm_max_ps(std::bit_cast<__m128>(a), std::bit_cast<__m128>(b)));
#endif
  using In = Plain<Register>;
  return std::bit_cast<Register>(In::of(a) > In::of(b) ? In::of(a) : In::of(b));
}

/// Roots of numbers >= 0.
template <class Register>
[[gnu::always_inline]] inline Register roots(const Register& a) {
#if defined(__AVX512F__)
  if constexpr (is_register<Register, double, 64>)
    return std::bit_cast<Register>(_mm512_maskz_sqrt_pd(0xff, std::bit_cast<__m512d>(a)));
  if constexpr (is_register<Register, float, 64>)
    return std::bit_cast<Register>(_mm512_maskz_sqrt_ps(0xffff, std::bit_cast<__m512>(a)));
#endif
  return simd::sqrt(a);
}

/// Without their signs.
template <class Register>
[[gnu::always_inline]] inline Register magnitudes(const Register& a) {
  using In = Plain<Register>;
  constexpr auto without_sign = std::numeric_limits<typename In::Integer>::max();
  return std::bit_cast<Register>(std::bit_cast<typename In::Bits>(In::of(a)) & without_sign);
}

/// Of whole numbers that have room in 32 bits.
template <class Register, class Integers = typename Plain<Register>::Integers>
[[gnu::always_inline]] inline Integers product(const Integers& a, const Integers& b) {
#if defined(__AVX512F__)
  if constexpr (is_register<Register, double, 64>)
    return std::bit_cast<Integers>(_mm512_maskz_mul_epi32(0xff, std::bit_cast<__m512i>(a), std::bit_cast<__m512i>(b)));
#endif
#if defined(__AVX2__)
  if constexpr (is_register<Register, double, 32>)
    return std::bit_cast<Integers>(_mm256_mul_epi32(std::bit_cast<__m256i>(a), std::bit_cast<__m256i>(b)));
#endif
  return a * b;
}

/// Whole numbers of 32 bits as numbers.
template <class Register>
[[gnu::always_inline]] inline Register numbers_of(const typename Plain<Register>::Integers& integers) {
  if constexpr (std::is_same_v<typename Register::value_type, double>) {
    // Added to the bits of 1.5 * 2^52 they are its last digits.
    constexpr double carry = 0x1.8p52;
    using In = Plain<Register>;
    const auto bits = In::of(integers) + std::bit_cast<std::int64_t>(carry);
    return std::bit_cast<Register>(std::bit_cast<typename In::Numbers>(bits) - carry);
  } else {
    return simd::static_simd_cast<Register>(integers);
  }
}

/// The integer parts of numbers that have room in 32 bits.
template <class Register>
[[gnu::always_inline]] inline typename Plain<Register>::Integers integers_of(const Register& numbers) {
  using Integers = typename Plain<Register>::Integers;
#if defined(__AVX512DQ__)
  if constexpr (is_register<Register, double, 64>)
    return std::bit_cast<Integers>(_mm512_maskz_cvttpd_epi64(0xff, std::bit_cast<__m512d>(numbers)));
  if constexpr (is_register<Register, float, 64>)
    return std::bit_cast<Integers>(_mm512_maskz_cvttps_epi32(0xffff, std::bit_cast<__m512>(numbers)));
#endif
#if defined(__AVX2__)
  if constexpr (is_register<Register, double, 32>)
    return std::bit_cast<Integers>(_mm256_cvtepi32_epi64(_mm256_cvttpd_epi32(std::bit_cast<__m256d>(numbers))));
#endif
  return simd::static_simd_cast<Integers>(numbers);
}

}  // namespace spoolflow::estimation::packs

#pragma once
/// All that the sensor asks of a compiler beyond standard C++17. GCC from 12 on and Clang from 14 on have it, and so
/// have compilers that are made of Clang (Arm Compiler 6 in Keil MDK). Every other one (IAR) takes the standard path,
/// and so does every one with -DSPOOLFLOW_STANDARD_CPP: the same answers, with more instructions a step.
#include <cstddef>
#include <cstdint>
#include <type_traits>

#if defined(__GNUC__) && !defined(SPOOLFLOW_STANDARD_CPP)
#define SPOOLFLOW_EXTENSIONS 1
#ifndef SPOOLFLOW_INLINE  // a build may leave it empty: the same answers
#define SPOOLFLOW_INLINE [[gnu::always_inline]]
#endif
#define SPOOLFLOW_NOINLINE [[gnu::noinline]]
#define SPOOLFLOW_FLATTEN [[gnu::flatten]]
#define SPOOLFLOW_INLINE_LAMBDA __attribute__((always_inline))
#else
#define SPOOLFLOW_EXTENSIONS 0
#define SPOOLFLOW_INLINE
#define SPOOLFLOW_NOINLINE
#define SPOOLFLOW_FLATTEN
#define SPOOLFLOW_INLINE_LAMBDA
#endif

// With -ffreestanding GCC from 13 on does not have it.
#if !SPOOLFLOW_EXTENSIONS || __STDC_HOSTED__
#include <cmath>
#endif

/// Whether bits_as() may stand in a constant expression. Where it may not, exported tables are built at the program's
/// start, in RAM; a page of parameters in flash is none the worse.
#if SPOOLFLOW_EXTENSIONS
#define SPOOLFLOW_CONSTANT_BITS 1
#elif __cplusplus >= 202002L
#include <bit>
#define SPOOLFLOW_CONSTANT_BITS 1
#else
#define SPOOLFLOW_CONSTANT_BITS 0
#endif
#if SPOOLFLOW_CONSTANT_BITS
#define SPOOLFLOW_TABLE constexpr
#else
#define SPOOLFLOW_TABLE const
#endif

namespace spoolflow::sensor {

/// What the compiler may lay out the step for; C++20 has attributes for it.
constexpr bool likely(bool condition) {
#if SPOOLFLOW_EXTENSIONS
  return __builtin_expect(condition, true);
#else
  return condition;
#endif
}
constexpr bool unlikely(bool condition) {
#if SPOOLFLOW_EXTENSIONS
  return __builtin_expect(condition, false);
#else
  return condition;
#endif
}

/// A value of the same bytes. Both types are trivially copyable and of one size.
template <class To, class From>
#if SPOOLFLOW_EXTENSIONS
SPOOLFLOW_INLINE constexpr To bits_as(const From& from) {
  return __builtin_bit_cast(To, from);
}
#elif SPOOLFLOW_CONSTANT_BITS
constexpr To bits_as(const From& from) {
  return std::bit_cast<To>(from);
}
#else
inline To bits_as(const From& from) {
  static_assert(sizeof(To) == sizeof(From) && std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
  To to{};
  const auto* const source = reinterpret_cast<const unsigned char*>(&from);
  auto* const target = reinterpret_cast<unsigned char*>(&to);
  for (std::size_t k = 0; k < sizeof to; ++k) target[k] = source[k];
  return to;
}
#endif

/// The word at an address that is a multiple of four.
inline std::uint32_t word_from(const void* place) {
  std::uint32_t word = 0;
#if SPOOLFLOW_EXTENSIONS
  __builtin_memcpy(&word, __builtin_assume_aligned(place, sizeof word), sizeof word);  // one load
#else
  const auto* const source = static_cast<const unsigned char*>(place);
  auto* const target = reinterpret_cast<unsigned char*>(&word);
  for (std::size_t k = 0; k < sizeof word; ++k) target[k] = source[k];
#endif
  return word;
}

#if SPOOLFLOW_EXTENSIONS
constexpr float magnitude(float value) {
  return __builtin_fabsf(value);
}
constexpr double magnitude(double value) {
  return __builtin_fabs(value);
}
#endif

/// The root of a number >= 0.
inline float sqrt(float value) {
#if SPOOLFLOW_EXTENSIONS && defined(__ARM_FP) && defined(__arm__)
  // The unit's instruction and nothing else: for the sake of errno a compiler would also call the library's sqrtf,
  // which firmware need not have.
  float root;
  __asm__("vsqrt.f32 %0, %1" : "=t"(root) : "t"(value));
  return root;
#elif SPOOLFLOW_EXTENSIONS
  return __builtin_sqrtf(value);
#else
  return std::sqrt(value);
#endif
}
inline double sqrt(double value) {
#if SPOOLFLOW_EXTENSIONS
  return __builtin_sqrt(value);
#else
  return std::sqrt(value);
#endif
}

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wfloat-equal"
#endif
/// Whether two numbers are the same; compilers warn of == where arithmetic may have come to either.
template <class T>
constexpr bool same(const T& one, const T& other) {
  return one == other;
}
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

}  // namespace spoolflow::sensor

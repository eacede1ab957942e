#pragma once
/// Random numbers of the virtual instruments. One seed and the name of a stream give the same numbers on every machine
/// and with every standard library; no draw of one stream shifts another.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "spoolflow/rig/numerics/elementary_functions.hpp"

namespace spoolflow::rig {

/// SplitMix64 (Steele, Lea, Flood 2014): a counter through a 64-bit mix; passes BigCrush, one word of state.
class Noise {
 public:
  constexpr Noise() = default;
  /// The stream `name` of `seed`; the name goes in by FNV-1a.
  constexpr Noise(std::uint64_t seed, std::string_view name) {
    std::uint64_t hash = 0xcbf29ce484222325ULL;
    for (const char letter : name) {
      hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3ULL;
    }
    counter_ = mix(seed + golden_gamma) ^ mix(hash);
  }

  /// Uniform over (0, 1), ends excluded, in steps of 2^-52.
  constexpr double uniform() {
    counter_ += golden_gamma;
    return (static_cast<double>(mix(counter_) >> 12U) + 0.5) * 0x1p-52;
  }
  constexpr double uniform(double from, double to) { return from + (to - from) * uniform(); }

  /// Standard normal by the inverse of its distribution: one uniform number, one normal number.
  double normal() { return inverse_normal(uniform()); }

  /// Time to the next event of a Poisson process [s]; infinite where the rate is zero.
  double waiting_time_s(double rate_per_s) {
    return rate_per_s > 0 ? -natural_logarithm(uniform()) / rate_per_s : HUGE_VAL;
  }

 private:
  static constexpr std::uint64_t golden_gamma = 0x9e3779b97f4a7c15ULL;
  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
  }
  /// Acklam's rational approximation of the inverse normal distribution, relative error below 1.2e-9.
  static double inverse_normal(double probability) {
    const double tail = 0.02425;
    const auto outer = [](double q) {
      return (((((-7.784894002430293e-03 * q - 3.223964580411365e-01) * q - 2.400758277161838) * q -
                2.549732539343734) *
                   q +
               4.374664141464968) *
                  q +
              2.938163982698783) /
             ((((7.784695709041462e-03 * q + 3.224671290700398e-01) * q + 2.445134137142996) * q + 3.754408661907416) *
                  q +
              1.0);
    };
    if (probability < tail) {
      return outer(std::sqrt(-2.0 * natural_logarithm(probability)));
    }
    if (probability > 1.0 - tail) {
      return -outer(std::sqrt(-2.0 * natural_logarithm(1.0 - probability)));
    }
    const double q = probability - 0.5;
    const double r = q * q;
    return (((((-3.969683028665376e+01 * r + 2.209460984245205e+02) * r - 2.759285104469687e+02) * r +
              1.383577518672690e+02) *
                 r -
             3.066479806614716e+01) *
                r +
            2.506628277459239) *
           q /
           (((((-5.447609879822406e+01 * r + 1.615858368580409e+02) * r - 1.556989798598866e+02) * r +
              6.680131188771972e+01) *
                 r -
             1.328068155288572e+01) *
                r +
            1.0);
  }

  std::uint64_t counter_ = 0;
};

}  // namespace spoolflow::rig

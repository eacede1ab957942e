#pragma once
/// Random numbers that follow from a seed alone, on every machine and in any order of work.
#include <cstdint>
#include <string_view>

#include "spoolflow/uncertainty/distribution.hpp"
#include "spoolflow/uncertainty/disturbed_sensor.hpp"

namespace spoolflow::uncertainty {

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): a bijection that spreads every bit over all.
constexpr std::uint64_t mixed_bits(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

/// One stream of numbers: that of trial `number` of a seed's purpose.
class SeededNumbers {
 public:
  constexpr SeededNumbers(std::uint64_t seed, std::string_view purpose, std::uint64_t number = 0) {
    std::uint64_t hash = mixed_bits(seed);
    for (const char letter : purpose) hash = mixed_bits(hash ^ static_cast<unsigned char>(letter));
    counter_ = mixed_bits(hash ^ mixed_bits(number));
  }

  constexpr std::uint64_t bits() { return mixed_bits(counter_ += 0x9e3779b97f4a7c15ULL); }
  /// Over (0, 1), ends excluded.
  constexpr double uniform() { return (static_cast<double>(bits() >> 12U) + 0.5) * 0x1p-52; }
  /// Mean 0, standard deviation 1.
  double normal() { return normal_quantile(uniform()); }
  /// From 0 to below `count`.
  constexpr std::uint64_t below(std::uint64_t count) {
    return static_cast<std::uint64_t>(uniform() * static_cast<double>(count));
  }

 private:
  std::uint64_t counter_ = 0;
};

/// Errors of which each sample has noise of its own: `error` holds the noises' standard deviations.
class NoisyErrors {
 public:
  /// Keeps a reference to the numbers.
  NoisyErrors(const InputErrors<double>& error, SeededNumbers& numbers)
      : now_(error),
        position_m_(error[InputQuantity::position_noise]),
        current_A_(error[InputQuantity::current_noise]),
        numbers_(numbers) {}
  /// Those of the next sample.
  const InputErrors<double>& next() {
    now_[InputQuantity::position_noise] = position_m_ == 0 ? 0 : position_m_ * numbers_.normal();
    now_[InputQuantity::current_noise] = current_A_ == 0 ? 0 : current_A_ * numbers_.normal();
    return now_;
  }

 private:
  InputErrors<double> now_;
  double position_m_, current_A_;
  SeededNumbers& numbers_;
};

}  // namespace spoolflow::uncertainty

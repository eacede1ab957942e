#pragma once
/// A scalar that stands for several valves at once: one number a valve, side by side in SIMD registers. The sensor's
/// templates run on it as they run on float; where float branches, a pack blends.
#include <array>
#include <cstdint>
#include <experimental/simd>

#include "spoolflow/sensor/sample.hpp"

namespace spoolflow::validation {

using Register = std::experimental::native_simd<float>;

/// Registers that hold N numbers, as the compiler's target has them.
template <int N>
inline constexpr std::size_t registers = static_cast<std::size_t>(N) / Register::size();

/// `of(register)` for each register.
template <class Pack, std::size_t Count, class Of>
[[gnu::always_inline]] inline Pack each_register(const Of& of) {
  Pack out;
#pragma GCC unroll 8
  for (std::size_t r = 0; r < Count; ++r) out.lanes[r] = of(r);
  return out;
}

template <int N>
struct PackTruth {
  std::array<std::experimental::native_simd_mask<float>, registers<N>> lanes;

  template <class Of>
  static PackTruth each(const Of& of) {
    return each_register<PackTruth, registers<N>>(of);
  }
  friend PackTruth operator!(const PackTruth& a) {
    return each([&](std::size_t r) { return !a.lanes[r]; });
  }
  friend PackTruth operator&&(const PackTruth& a, const PackTruth& b) {
    return each([&](std::size_t r) { return a.lanes[r] && b.lanes[r]; });
  }
};

template <int N>
struct PackIndex {
  std::array<std::int32_t, N> lanes;

  friend PackIndex operator*(PackIndex a, int factor) {
    for (std::int32_t& lane : a.lanes) lane *= factor;
    return a;
  }
  friend PackIndex operator+(PackIndex a, const PackIndex& b) {
    for (std::size_t k = 0; k < N; ++k) a.lanes[k] += b.lanes[k];
    return a;
  }
};

template <int N>
struct ValvePack {
  static_assert(N % Register::size() == 0);
  using Numbers = std::array<float, N>;
  std::array<Register, registers<N>> lanes{};

  ValvePack() = default;
  explicit ValvePack(float value) { lanes.fill(Register(value)); }
  explicit ValvePack(double value) : ValvePack(static_cast<float>(value)) {}
  explicit ValvePack(int value) : ValvePack(static_cast<float>(value)) {}
  explicit ValvePack(const Numbers& numbers) {
    for (std::size_t r = 0; r < lanes.size(); ++r)
      lanes[r].copy_from(numbers.data() + r * Register::size(), std::experimental::element_aligned);
  }
  explicit ValvePack(const PackIndex<N>& index) {
    for (std::size_t r = 0; r < lanes.size(); ++r)
      lanes[r].copy_from(index.lanes.data() + r * Register::size(), std::experimental::element_aligned);
  }
  [[nodiscard]] Numbers numbers() const {
    Numbers out;
    for (std::size_t r = 0; r < lanes.size(); ++r)
      lanes[r].copy_to(out.data() + r * Register::size(), std::experimental::element_aligned);
    return out;
  }

  template <class Of>
  static ValvePack each(const Of& of) {
    return each_register<ValvePack, registers<N>>(of);
  }
  friend ValvePack operator-(const ValvePack& a) {
    return each([&](std::size_t r) { return -a.lanes[r]; });
  }
  friend ValvePack operator+(const ValvePack& a, const ValvePack& b) {
    return each([&](std::size_t r) { return a.lanes[r] + b.lanes[r]; });
  }
  friend ValvePack operator-(const ValvePack& a, const ValvePack& b) {
    return each([&](std::size_t r) { return a.lanes[r] - b.lanes[r]; });
  }
  friend ValvePack operator*(const ValvePack& a, const ValvePack& b) {
    return each([&](std::size_t r) { return a.lanes[r] * b.lanes[r]; });
  }
  friend ValvePack operator/(const ValvePack& a, const ValvePack& b) {
    return each([&](std::size_t r) { return a.lanes[r] / b.lanes[r]; });
  }
  friend PackTruth<N> operator==(const ValvePack& a, const ValvePack& b) {
    return PackTruth<N>::each([&](std::size_t r) { return a.lanes[r] == b.lanes[r]; });
  }
  friend PackTruth<N> operator<(const ValvePack& a, const ValvePack& b) {
    return PackTruth<N>::each([&](std::size_t r) { return a.lanes[r] < b.lanes[r]; });
  }
  friend PackTruth<N> operator<=(const ValvePack& a, const ValvePack& b) {
    return PackTruth<N>::each([&](std::size_t r) { return a.lanes[r] <= b.lanes[r]; });
  }
  friend PackTruth<N> operator>(const ValvePack& a, const ValvePack& b) { return b < a; }
  friend PackTruth<N> operator>=(const ValvePack& a, const ValvePack& b) { return b <= a; }
};

template <int N>
ValvePack<N> select(const PackTruth<N>& condition, const ValvePack<N>& yes, const ValvePack<N>& no) {
  ValvePack<N> out = no;
  for (std::size_t r = 0; r < registers<N>; ++r) where(condition.lanes[r], out.lanes[r]) = yes.lanes[r];
  return out;
}

template <int N>
ValvePack<N> sqrt(const ValvePack<N>& a) {
  return ValvePack<N>::each([&](std::size_t r) { return std::experimental::sqrt(a.lanes[r]); });
}

template <int N>
PackIndex<N> table_index(const ValvePack<N>& value) {
  const auto numbers = value.numbers();
  PackIndex<N> out;
  for (std::size_t k = 0; k < N; ++k) out.lanes[k] = static_cast<std::int32_t>(numbers[k]);
  return out;
}

/// The same table of each valve, where that valve's parameters have it: what is read together lies together.
template <int N>
struct PackTable {
  std::array<const float*, N> of_valve{};

  [[nodiscard]] const PackTable& data() const { return *this; }
};

/// Each valve reads its own table at its own place.
template <int N>
struct PackCorner {
  std::array<const float*, N> from;

  ValvePack<N> operator[](int distance) const {
    return ValvePack<N>::each([&](std::size_t r) {
      // Put together in the register: numbers stored one by one and loaded as a whole would make the processor wait.
      return Register([&](auto k) { return from[r * Register::size() + k][distance]; });
    });
  }
};

template <int N>
PackCorner<N> corner(const PackTable<N>& table, const PackIndex<N>& index) {
  PackCorner<N> out;
  for (std::size_t k = 0; k < N; ++k) out.from[k] = table.of_valve[k] + index.lanes[k];
  return out;
}

template <int N>
PackCorner<N> onward(PackCorner<N> corner, const PackIndex<N>& index) {
  for (std::size_t k = 0; k < N; ++k) corner.from[k] += index.lanes[k];
  return corner;
}

/// Status words. As sums of powers of two they are whole numbers that a float holds exactly (bits below 2^24); each bit
/// is added once at most.
template <int N>
struct PackStatus {
  ValvePack<N> words;

  friend PackStatus operator|(const PackStatus& a, const PackStatus& b) { return {a.words + b.words}; }
  [[nodiscard]] sensor::Status at(std::size_t valve) const {
    return static_cast<sensor::Status>(static_cast<std::uint32_t>(words.numbers()[valve]));
  }
};

template <int N>
PackStatus<N> when(const PackTruth<N>& condition, sensor::Status bit) {
  const auto word = static_cast<float>(static_cast<std::uint32_t>(bit));
  return {select(condition, ValvePack<N>(word), ValvePack<N>(0))};
}

template <int N>
void mark(PackStatus<N>& status, const PackTruth<N>& condition, sensor::Status bit) {
  status = status | when(condition, bit);
}

/// Valves whose sample is unusable keep the answer that they had before, with the reason as status.
template <int N>
void hold(const PackStatus<N>& held, const sensor::Estimate<ValvePack<N>>& before,
          sensor::Estimate<ValvePack<N>>& estimate) {
  using Answer = sensor::Estimate<ValvePack<N>>;
  const PackTruth<N> keep = ValvePack<N>(0) < held.words;
  bool any = false;
  for (const auto& lanes : keep.lanes) any = any || any_of(lanes);
  if (!any) return;
  for (auto number : {&Answer::flow_m3_per_s, &Answer::flow_lower_m3_per_s, &Answer::flow_upper_m3_per_s,
                      &Answer::pressure_difference_Pa, &Answer::magnetic_force_N, &Answer::spring_force_N,
                      &Answer::flow_force_N, &Answer::friction_force_N}) {
    estimate.*number = select(keep, before.*number, estimate.*number);
  }
  estimate.status.words = select(keep, held.words, estimate.status.words);
}

}  // namespace spoolflow::validation

template <int N>
struct spoolflow::sensor::ScalarTypes<spoolflow::validation::ValvePack<N>> {
  template <int Count>
  using Numbers = spoolflow::validation::PackTable<N>;
  using Truth = spoolflow::validation::PackTruth<N>;
  using Index = spoolflow::validation::PackIndex<N>;
  using StatusWord = spoolflow::validation::PackStatus<N>;
};

#pragma once
/// Tables and rings of several valves, each with its own numbers. A register fetches from all of them by turning rows
/// into lanes: each valve's neighbouring numbers are loaded at once and then dealt out.
#include "spoolflow/estimation/packs/pack_status.hpp"

namespace spoolflow::estimation::packs {

/// The same table of each valve, counted from a beginning that all valves' numbers have in common. Both lie as packs
/// do, so that `keep` may take some valves' tables from here and others' from another PackTable of the same beginning.
template <class Register, int Count>
struct PackTable {
  alignas(sizeof(PackIndex<Register, Count>)) const typename Lanes<Register, Count>::Number* numbers = nullptr;
  alignas(sizeof(PackIndex<Register, Count>)) PackIndex<Register, Count> first;

  [[nodiscard]] const PackTable& data() const { return *this; }
};

/// Each valve's own place in its own table.
template <class Register, int Count>
struct PackCorner {
  const typename Lanes<Register, Count>::Number* numbers;
  PackIndex<Register, Count> place;
};

template <class Register, int Count>
PackCorner<Register, Count> corner(const PackTable<Register, Count>& table, const PackIndex<Register, Count>& place) {
  return {table.numbers, table.first + place};
}

template <class Register, int Count>
PackCorner<Register, Count> onward(const PackCorner<Register, Count>& from, const PackIndex<Register, Count>& places) {
  return {from.numbers, from.place + places};
}

namespace detail {

using Row [[gnu::vector_size(16)]] = float;  ///< four numbers of one valve
/// Two.
template <class Number>
struct PairOf {
  using Numbers [[gnu::vector_size(2 * sizeof(Number))]] = Number;
};

template <class Numbers, class Number>
[[gnu::always_inline]] inline Numbers numbers_at(const Number* from) {
  Numbers out;
  std::memcpy(&out, from, sizeof out);
  return out;
}

/// Rows of a register's valves, dealt out: the k-th register has the k-th number of each valve.
template <class Register, class RowOf>
[[gnu::always_inline]] inline std::array<Register, 4> rows_to_lanes(const RowOf& row) {
  if constexpr (Register::size() == 16) {
    const auto joined = [&](std::size_t k) {
      const auto low = __builtin_shufflevector(row(k), row(k + 4), 0, 1, 2, 3, 4, 5, 6, 7);
      const auto high = __builtin_shufflevector(row(k + 8), row(k + 12), 0, 1, 2, 3, 4, 5, 6, 7);
      return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    };
    const auto a = joined(0), b = joined(1), c = joined(2), d = joined(3);
    const auto low_ab = __builtin_shufflevector(a, b, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
    const auto high_ab = __builtin_shufflevector(a, b, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
    const auto low_cd = __builtin_shufflevector(c, d, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
    const auto high_cd = __builtin_shufflevector(c, d, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
    const auto firsts = [](auto ab, auto cd) {
      return std::bit_cast<Register>(
          __builtin_shufflevector(ab, cd, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29));
    };
    const auto seconds = [](auto ab, auto cd) {
      return std::bit_cast<Register>(
          __builtin_shufflevector(ab, cd, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31));
    };
    return {firsts(low_ab, low_cd), seconds(low_ab, low_cd), firsts(high_ab, high_cd), seconds(high_ab, high_cd)};
  } else if constexpr (Register::size() == 8) {
    const auto both = [&](std::size_t k) {
#if defined(__AVX__)
      return _mm256_insertf128_ps(_mm256_castps128_ps256(row(k)), row(k + 4), 1);
#else
      return __builtin_shufflevector(row(k), row(k + 4), 0, 1, 2, 3, 4, 5, 6, 7);
#endif
    };
    const auto a = both(0), b = both(1), c = both(2), d = both(3);
    const auto low_ab = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
    const auto high_ab = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
    const auto low_cd = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
    const auto high_cd = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
    return {std::bit_cast<Register>(__builtin_shufflevector(low_ab, low_cd, 0, 1, 8, 9, 4, 5, 12, 13)),
            std::bit_cast<Register>(__builtin_shufflevector(low_ab, low_cd, 2, 3, 10, 11, 6, 7, 14, 15)),
            std::bit_cast<Register>(__builtin_shufflevector(high_ab, high_cd, 0, 1, 8, 9, 4, 5, 12, 13)),
            std::bit_cast<Register>(__builtin_shufflevector(high_ab, high_cd, 2, 3, 10, 11, 6, 7, 14, 15))};
  } else {
    static_assert(Register::size() == 4);
    const Row a = row(0), b = row(1), c = row(2), d = row(3);
    const Row low_ab = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Row high_ab = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Row low_cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Row high_cd = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    return {std::bit_cast<Register>(__builtin_shufflevector(low_ab, low_cd, 0, 1, 4, 5)),
            std::bit_cast<Register>(__builtin_shufflevector(low_ab, low_cd, 2, 3, 6, 7)),
            std::bit_cast<Register>(__builtin_shufflevector(high_ab, high_cd, 0, 1, 4, 5)),
            std::bit_cast<Register>(__builtin_shufflevector(high_ab, high_cd, 2, 3, 6, 7))};
  }
}

/// The same of two numbers a valve.
template <class Register, class PairAt>
[[gnu::always_inline]] inline std::array<Register, 2> pairs_to_lanes(const PairAt& pair) {
  const auto two = [&](std::size_t k) { return __builtin_shufflevector(pair(k), pair(k + 1), 0, 1, 2, 3); };
  if constexpr (Register::size() == 16) {
    const auto joined = [&](std::size_t k) {
      const auto low = __builtin_shufflevector(two(k), two(k + 4), 0, 1, 2, 3, 4, 5, 6, 7);
      const auto high = __builtin_shufflevector(two(k + 8), two(k + 12), 0, 1, 2, 3, 4, 5, 6, 7);
      return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    };
    const auto a = joined(0), b = joined(2);
    return {std::bit_cast<Register>(
                __builtin_shufflevector(a, b, 0, 2, 16, 18, 4, 6, 20, 22, 8, 10, 24, 26, 12, 14, 28, 30)),
            std::bit_cast<Register>(
                __builtin_shufflevector(a, b, 1, 3, 17, 19, 5, 7, 21, 23, 9, 11, 25, 27, 13, 15, 29, 31))};
  } else if constexpr (Register::size() == 8) {
    const auto a = __builtin_shufflevector(two(0), two(4), 0, 1, 2, 3, 4, 5, 6, 7);
    const auto b = __builtin_shufflevector(two(2), two(6), 0, 1, 2, 3, 4, 5, 6, 7);
    return {std::bit_cast<Register>(__builtin_shufflevector(a, b, 0, 2, 8, 10, 4, 6, 12, 14)),
            std::bit_cast<Register>(__builtin_shufflevector(a, b, 1, 3, 9, 11, 5, 7, 13, 15))};
  } else {
    static_assert(Register::size() == 4);
    const Row a = two(0), b = two(2);
    return {std::bit_cast<Register>(__builtin_shufflevector(a, b, 0, 2, 4, 6)),
            std::bit_cast<Register>(__builtin_shufflevector(a, b, 1, 3, 5, 7))};
  }
}

/// Of two doubles a valve.
template <class Register, class PairAt>
requires std::is_same_v<typename Register::value_type, double>
[[gnu::always_inline]] inline std::array<Register, 2> pairs_to_lanes(const PairAt& pair) {
  // What 128 bits hold of two valves is dealt out within them.
  const auto two = [&](std::size_t k) { return __builtin_shufflevector(pair(k), pair(k + 2), 0, 1, 2, 3); };
  if constexpr (Register::size() == 4) {
    const auto even = two(0), odd = two(1);
    return {std::bit_cast<Register>(__builtin_shufflevector(even, odd, 0, 4, 2, 6)),
            std::bit_cast<Register>(__builtin_shufflevector(even, odd, 1, 5, 3, 7))};
  } else {
    static_assert(Register::size() == 8);
    const auto even = __builtin_shufflevector(two(0), two(4), 0, 1, 2, 3, 4, 5, 6, 7);
    const auto odd = __builtin_shufflevector(two(1), two(5), 0, 1, 2, 3, 4, 5, 6, 7);
    return {std::bit_cast<Register>(__builtin_shufflevector(even, odd, 0, 8, 2, 10, 4, 12, 6, 14)),
            std::bit_cast<Register>(__builtin_shufflevector(even, odd, 1, 9, 3, 11, 5, 13, 7, 15))};
  }
}

/// Neighbours of every valve's place, `deal` making lanes of one register's.
template <class Neighbours, class Register, int Count, class Deal>
[[gnu::always_inline]] inline auto fetch(const PackCorner<Register, Count>& from, int number, const Deal& deal) {
  const auto lanes_of = [&](std::size_t r) {
    // Of 32 bits two places a transfer: from vector to integer registers there is but a narrow path.
    const auto places = std::bit_cast<std::array<std::uint64_t, sizeof(Register) / 8>>(from.place.lanes[r]);
    constexpr std::size_t at_once = Register::size() / places.size();
    return deal([&](std::size_t valve) {
      const std::uint64_t both = places[valve / at_once];
      const std::uint64_t place = at_once == 1 ? both : valve % 2 == 0 ? both & 0xFFFFFFFFU : both >> 32U;
      return numbers_at<Neighbours>(from.numbers + static_cast<std::int64_t>(place) + number);
    });
  };
  const auto lanes = [&]<std::size_t... r>(std::index_sequence<r...>) __attribute__((always_inline)) {
    return std::array<decltype(lanes_of(0)), Count>{lanes_of(r)...};
  }
  (std::make_index_sequence<Count>());
  using Pack = ValvePack<Register, Count>;
  return [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
    return std::array{each_register<Pack>([&](std::size_t r) { return lanes[r][k]; })...};
  }
  (std::make_index_sequence<sizeof(Neighbours) / sizeof(typename Lanes<Register, Count>::Number)>());
}

}  // namespace detail

template <class Register, int Count>
[[gnu::always_inline]] inline std::array<ValvePack<Register, Count>, 4> four(const PackCorner<Register, Count>& from,
                                                                             int number) {
  return detail::fetch<detail::Row>(from, number, [](const auto& row) { return detail::rows_to_lanes<Register>(row); });
}

template <class Register, int Count>
[[gnu::always_inline]] inline std::array<ValvePack<Register, Count>, 2> two(const PackCorner<Register, Count>& from,
                                                                            int number) {
  using Pair = typename detail::PairOf<typename Lanes<Register, Count>::Number>::Numbers;
  return detail::fetch<Pair>(from, number, [](const auto& pair) { return detail::pairs_to_lanes<Register>(pair); });
}

/// Each valve's own number of a ring.
template <class Register, int Count, std::size_t Size>
ValvePack<Register, Count> in_ring(const std::array<ValvePack<Register, Count>, Size>& ring,
                                   const PackIndex<Register, Count>& place) {
  using Lanes = estimation::packs::Lanes<Register, Count>;
  using Number = typename Lanes::Number;
  const auto places = std::bit_cast<std::array<typename Lanes::Integer, Lanes::valves>>(place.lanes);
  static_assert(sizeof ring[0] == Lanes::valves * sizeof(Number), "entry after entry, in each the valves side by side");
  const auto* const numbers = reinterpret_cast<const Number*>(ring.data());
  return each_register<ValvePack<Register, Count>>([&](std::size_t r) {
    return Register([&](auto k) {
      const std::size_t valve = r * Lanes::width + k;
      return numbers[static_cast<std::size_t>(places[valve]) * Lanes::valves + valve];
    });
  });
}
template <class Register, int Count, std::size_t Size>
void put_in_ring(std::array<ValvePack<Register, Count>, Size>& ring, const PackIndex<Register, Count>& place,
                 const ValvePack<Register, Count>& value) {
  using Lanes = estimation::packs::Lanes<Register, Count>;
  using Number = typename Lanes::Number;
  const auto places = std::bit_cast<std::array<typename Lanes::Integer, Lanes::valves>>(place.lanes);
  const auto values = std::bit_cast<std::array<Number, Lanes::valves>>(value.lanes);
  auto* const numbers = reinterpret_cast<Number*>(ring.data());
  for (std::size_t valve = 0; valve < Lanes::valves; ++valve)
    numbers[static_cast<std::size_t>(places[valve]) * Lanes::valves + valve] = values[valve];
}

}  // namespace spoolflow::estimation::packs

template <class Register, int Count>
struct spoolflow::sensor::ScalarTypes<spoolflow::estimation::packs::ValvePack<Register, Count>> {
  template <int Size>
  using Numbers = spoolflow::estimation::packs::PackTable<Register, Count>;
  using Mask = spoolflow::estimation::packs::PackMask<Register, Count>;
  using Index = spoolflow::estimation::packs::PackIndex<Register, Count>;
  using StatusWord = spoolflow::estimation::packs::PackStatus<Register, Count>;
};

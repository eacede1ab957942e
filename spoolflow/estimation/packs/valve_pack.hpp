#pragma once
/// A scalar that stands for several valves at once: one number a valve, side by side in SIMD registers. The sensor's
/// templates run on it as they run on float or double; where those branch, a pack blends. In packs of double every
/// valve's numbers are to the last bit those of its sensor alone.
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <utility>

#include "spoolflow/estimation/packs/registers.hpp"
#include "spoolflow/sensor/position_track.hpp"
#include "spoolflow/sensor/sample.hpp"

namespace spoolflow::estimation::packs {

/// What the packs of `Count` registers are made of; each kind has one number of the same size a valve.
template <class Register, int Count>
struct Lanes {
  static constexpr std::size_t registers = Count;
  static constexpr std::size_t width = Register::size();
  static constexpr std::size_t valves = registers * width;
  using Number = typename Plain<Register>::Number;
  using Integer = typename Plain<Register>::Integer;
  using Integers = typename Plain<Register>::Integers;
};

/// `of(register)` for each register.
template <class Pack, class Of>
[[gnu::always_inline]] inline Pack each_register(const Of& of) {
  return [&]<std::size_t... r>(std::index_sequence<r...>) __attribute__((always_inline)) {
    return Pack{{of(r)...}};
  }
  (std::make_index_sequence<std::tuple_size_v<decltype(Pack::lanes)>>());
}

/// The answers of a comparison: all bits of a valve's number where it holds, none where it does not.
template <class Register, int Count>
struct PackMask {
  using Integers = typename Lanes<Register, Count>::Integers;
  std::array<Integers, Count> lanes{};

  PackMask() = default;
  explicit PackMask(const std::array<Integers, Count>& all) : lanes(all) {}
  explicit PackMask(bool value) { lanes.fill(Integers(typename Lanes<Register, Count>::Integer{value ? -1 : 0})); }

  friend PackMask operator!(const PackMask& a) {
    return each_register<PackMask>([&](std::size_t r) { return ~a.lanes[r]; });
  }
  friend PackMask operator&&(const PackMask& a, const PackMask& b) {
    return each_register<PackMask>([&](std::size_t r) { return a.lanes[r] & b.lanes[r]; });
  }
  friend PackMask operator||(const PackMask& a, const PackMask& b) {
    return each_register<PackMask>([&](std::size_t r) { return a.lanes[r] | b.lanes[r]; });
  }
};

/// `compare(register)` for each register.
template <class Register, int Count, class Compare>
[[gnu::always_inline]] inline PackMask<Register, Count> each_comparison(const Compare& compare) {
  using Integers = typename Lanes<Register, Count>::Integers;
  return each_register<PackMask<Register, Count>>([&](std::size_t r) { return std::bit_cast<Integers>(compare(r)); });
}

/// Whether it holds for one valve at least.
template <class Register, int Count>
bool any(const PackMask<Register, Count>& mask) {
  auto joined = mask.lanes[0];
  for (std::size_t r = 1; r < Count; ++r) joined |= mask.lanes[r];
  return any_lane<Register>(joined);
}

/// Whole numbers: places in tables, counts.
template <class Register, int Count>
struct PackIndex {
  using Integer = typename Lanes<Register, Count>::Integer;
  using Integers = typename Lanes<Register, Count>::Integers;
  using In = Plain<Register>;
  using Mask = PackMask<Register, Count>;
  std::array<Integers, Count> lanes{};

  PackIndex() = default;
  explicit PackIndex(const std::array<Integers, Count>& all) : lanes(all) {}
  explicit PackIndex(int value) { lanes.fill(whole(value)); }
  explicit PackIndex(sensor::Motion motion) : PackIndex(static_cast<int>(motion)) {}

  friend PackIndex operator+(const PackIndex& a, int b) { return a + PackIndex(b); }
  friend PackIndex operator-(const PackIndex& a, int b) { return a + PackIndex(-b); }
  friend PackIndex operator&(const PackIndex& a, int b) {
    return each_register<PackIndex>([&](std::size_t r) { return a.lanes[r] & whole(b); });
  }
  friend Mask operator==(const PackIndex& a, int b) {
    return each_comparison<Register, Count>([&](std::size_t r) { return In::of(a.lanes[r]) == In::of(whole(b)); });
  }
  friend Mask operator>(const PackIndex& a, int b) {
    return each_comparison<Register, Count>([&](std::size_t r) { return In::of(a.lanes[r]) > In::of(whole(b)); });
  }
  friend Mask operator<(const PackIndex& a, int b) {
    return each_comparison<Register, Count>([&](std::size_t r) { return In::of(a.lanes[r]) < In::of(whole(b)); });
  }
  friend Mask is(const PackIndex& motion, sensor::Motion which) { return motion == static_cast<int>(which); }
  friend PackIndex select(const Mask& condition, const PackIndex& yes, const PackIndex& no) {
    return each_register<PackIndex>(
        [&](std::size_t r) { return (yes.lanes[r] & condition.lanes[r]) | (no.lanes[r] & ~condition.lanes[r]); });
  }
  friend PackIndex operator*(const PackIndex& a, int factor) {
    return each_register<PackIndex>([&](std::size_t r) { return product<Register>(a.lanes[r], whole(factor)); });
  }
  friend PackIndex operator+(const PackIndex& a, const PackIndex& b) {
    return each_register<PackIndex>([&](std::size_t r) { return a.lanes[r] + b.lanes[r]; });
  }

 private:
  static Integers whole(int value) { return Integers(Integer{value}); }
};

template <class Register, int Count>
struct ValvePack {
  using Lanes = packs::Lanes<Register, Count>;
  using Mask = PackMask<Register, Count>;
  using Index = PackIndex<Register, Count>;
  using Number = typename Lanes::Number;
  using In = Plain<Register>;
  std::array<Register, Count> lanes{};

  ValvePack() = default;
  explicit ValvePack(const std::array<Register, Count>& numbers) : lanes(numbers) {}
  template <class Value>
  requires std::is_arithmetic_v<Value>
  explicit ValvePack(Value value) { lanes.fill(Register(static_cast<Number>(value))); }
  explicit ValvePack(const Index& index)
      : ValvePack(each_register<ValvePack>([&](std::size_t r) { return numbers_of<Register>(index.lanes[r]); })) {}

  /// A number a valve, from there on.
  static ValvePack read(const Number* from) {
    return each_register<ValvePack>([&](std::size_t r) { return Register(from + r * Lanes::width, unaligned); });
  }
  void write(Number* to) const {
    for (std::size_t r = 0; r < lanes.size(); ++r) lanes[r].copy_to(to + r * Lanes::width, unaligned);
  }

  friend ValvePack operator-(const ValvePack& a) {
    return each_register<ValvePack>([&](std::size_t r) { return -a.lanes[r]; });
  }
  friend ValvePack operator+(const ValvePack& a, const ValvePack& b) {
    return each_register<ValvePack>([&](std::size_t r) { return a.lanes[r] + b.lanes[r]; });
  }
  friend ValvePack operator-(const ValvePack& a, const ValvePack& b) {
    return each_register<ValvePack>([&](std::size_t r) { return a.lanes[r] - b.lanes[r]; });
  }
  friend ValvePack operator*(const ValvePack& a, const ValvePack& b) {
    return each_register<ValvePack>([&](std::size_t r) { return a.lanes[r] * b.lanes[r]; });
  }
  friend ValvePack operator/(const ValvePack& a, const ValvePack& b) {
    return each_register<ValvePack>([&](std::size_t r) { return a.lanes[r] / b.lanes[r]; });
  }
  ValvePack& operator+=(const ValvePack& b) { return *this = *this + b; }
  ValvePack& operator-=(const ValvePack& b) { return *this = *this - b; }
  friend Mask operator==(const ValvePack& a, const ValvePack& b) {
    return each_comparison<Register, Count>([&](std::size_t r) { return In::of(a.lanes[r]) == In::of(b.lanes[r]); });
  }
  friend Mask operator!=(const ValvePack& a, const ValvePack& b) { return !(a == b); }
  friend Mask operator<(const ValvePack& a, const ValvePack& b) {
    return each_comparison<Register, Count>([&](std::size_t r) { return In::of(a.lanes[r]) < In::of(b.lanes[r]); });
  }
  friend Mask operator<=(const ValvePack& a, const ValvePack& b) {
    return each_comparison<Register, Count>([&](std::size_t r) { return In::of(a.lanes[r]) <= In::of(b.lanes[r]); });
  }
  friend Mask operator>(const ValvePack& a, const ValvePack& b) { return b < a; }
  friend Mask operator>=(const ValvePack& a, const ValvePack& b) { return b <= a; }

 private:
  static constexpr simd::element_aligned_tag unaligned{};
};

template <class Register, int Count>
ValvePack<Register, Count> select(const PackMask<Register, Count>& condition, const ValvePack<Register, Count>& yes,
                                  const ValvePack<Register, Count>& no) {
  return each_register<ValvePack<Register, Count>>(
      [&](std::size_t r) { return blended(condition.lanes[r], yes.lanes[r], no.lanes[r]); });
}

template <class Register, int Count>
ValvePack<Register, Count> smaller(const ValvePack<Register, Count>& a, const ValvePack<Register, Count>& b) {
  return each_register<ValvePack<Register, Count>>([&](std::size_t r) { return lesser(b.lanes[r], a.lanes[r]); });
}

template <class Register, int Count>
ValvePack<Register, Count> larger(const ValvePack<Register, Count>& a, const ValvePack<Register, Count>& b) {
  return each_register<ValvePack<Register, Count>>([&](std::size_t r) { return greater(b.lanes[r], a.lanes[r]); });
}

template <class Register, int Count>
ValvePack<Register, Count> sqrt(const ValvePack<Register, Count>& a) {
  return each_register<ValvePack<Register, Count>>([&](std::size_t r) { return roots(a.lanes[r]); });
}

template <class Register, int Count>
ValvePack<Register, Count> magnitude(const ValvePack<Register, Count>& a) {
  return each_register<ValvePack<Register, Count>>([&](std::size_t r) { return magnitudes(a.lanes[r]); });
}

template <class Register, int Count>
PackMask<Register, Count> is_number(const ValvePack<Register, Count>& a) {
  return magnitude(a) < ValvePack<Register, Count>(0x1p30);
}

template <class Register, int Count>
requires std::is_same_v<typename Register::value_type, double> ValvePack<Register, Count> share_of_cell(
    const ValvePack<Register, Count>& raw, const ValvePack<Register, Count>& share) {
  return select(raw == ValvePack<Register, Count>(0), raw, share);
}

template <class Register, int Count>
PackIndex<Register, Count> table_index(const ValvePack<Register, Count>& value) {
  using Index = PackIndex<Register, Count>;
  return each_register<Index>([&](std::size_t r) { return integers_of(value.lanes[r]); });
}

/// Of `kept`, what belongs to the valves of `condition`, in place of what `out` has. Both are made of packs and nothing
/// else, one number a valve each.
template <class Register, int Count, class Packs>
void keep(const PackMask<Register, Count>& condition, const Packs& kept, Packs& out) {
  static_assert(sizeof(Packs) % sizeof(condition) == 0 && std::is_trivially_copyable_v<Packs>);
  for (std::size_t k = 0; k < sizeof(Packs) / sizeof(Register); ++k) {
    Register old, now;
    std::memcpy(&old, reinterpret_cast<const char*>(&kept) + k * sizeof(Register), sizeof(Register));
    std::memcpy(&now, reinterpret_cast<const char*>(&out) + k * sizeof(Register), sizeof(Register));
    now = blended(condition.lanes[k % Count], old, now);
    std::memcpy(reinterpret_cast<char*>(&out) + k * sizeof(Register), &now, sizeof(Register));
  }
}

/// Memory for a copy of packs, which is made only where it is needed.
template <class Packs>
union Copy {
  Copy() {}
  Packs packs;
};

/// Where it holds for all valves, nothing need be taken back, nor a copy made, if it is more than a handful of packs.
template <class Register, int Count, class State, class Body>
[[gnu::always_inline]] inline void in_valves(const PackMask<Register, Count>& condition, State& state,
                                             const Body& body) {
  if (!any(condition)) return;
  const PackMask<Register, Count> others = !condition;
  if constexpr (sizeof(State) <= 16 * sizeof others) {
    const State before = state;
    body();
    keep(others, before, state);
  } else {
    const bool differ = any(others);
    Copy<State> before;
    if (differ) before.packs = state;
    body();
    if (differ) keep(others, before.packs, state);
  }
}

}  // namespace spoolflow::estimation::packs

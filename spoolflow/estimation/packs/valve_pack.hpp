#pragma once
/// A scalar that stands for several valves at once: one number a valve, side by side in SIMD registers. The sensor's
/// templates run on it as they run on float or double; where those branch, a pack blends. In packs of double every
/// valve's numbers are to the last bit those of its sensor alone.
#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <tuple>
#include <utility>

#include "spoolflow/estimation/packs/registers.hpp"
#include "spoolflow/numerics/members.hpp"
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

/// The answers of a comparison.
template <class Register, int Count>
struct PackMask {
  static constexpr bool answers_are_bits = compares_to_bits<Register>;
  std::array<Answers<Register>, Count> lanes{};

  PackMask() = default;
  explicit PackMask(const std::array<Answers<Register>, Count>& all) : lanes(all) {}
  template <std::same_as<bool> Bool>
  explicit PackMask(Bool value) {
    lanes.fill(answers<Register>(value));
  }

  friend PackMask operator!(const PackMask& a) {
    return each_register<PackMask>([&](std::size_t r) { return negated(a.lanes[r]); });
  }
  friend PackMask operator&&(const PackMask& a, const PackMask& b) {
    return each_register<PackMask>(
        [&](std::size_t r) { return static_cast<Answers<Register>>(a.lanes[r] & b.lanes[r]); });
  }
  friend PackMask operator||(const PackMask& a, const PackMask& b) {
    return each_register<PackMask>(
        [&](std::size_t r) { return static_cast<Answers<Register>>(a.lanes[r] | b.lanes[r]); });
  }
};

/// Whether it holds for one valve at least.
template <class Register, int Count>
bool any(const PackMask<Register, Count>& mask) {
  auto joined = mask.lanes[0];
  for (std::size_t r = 1; r < Count; ++r) joined = static_cast<Answers<Register>>(joined | mask.lanes[r]);
  return any_lane<Register>(joined);
}

/// Whole numbers: places in tables, counts.
template <class Register, int Count>
struct PackIndex {
  using Integer = typename Lanes<Register, Count>::Integer;
  using Integers = typename Lanes<Register, Count>::Integers;
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
    return each_register<Mask>(
        [&](std::size_t r) { return compared_integers<Relation::equal, Register>(a.lanes[r], whole(b)); });
  }
  friend Mask operator>(const PackIndex& a, int b) {
    return each_register<Mask>(
        [&](std::size_t r) { return compared_integers<Relation::less, Register>(whole(b), a.lanes[r]); });
  }
  friend Mask operator<(const PackIndex& a, int b) {
    return each_register<Mask>(
        [&](std::size_t r) { return compared_integers<Relation::less, Register>(a.lanes[r], whole(b)); });
  }
  friend Mask is(const PackIndex& motion, sensor::Motion which) { return motion == static_cast<int>(which); }
  friend PackIndex select(const Mask& condition, const PackIndex& yes, const PackIndex& no) {
    return each_register<PackIndex>(
        [&](std::size_t r) { return blended_integers<Register>(condition.lanes[r], yes.lanes[r], no.lanes[r]); });
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
    return each_register<Mask>([&](std::size_t r) { return compared<Relation::equal>(a.lanes[r], b.lanes[r]); });
  }
  friend Mask operator!=(const ValvePack& a, const ValvePack& b) { return !(a == b); }
  friend Mask operator<(const ValvePack& a, const ValvePack& b) {
    return each_register<Mask>([&](std::size_t r) { return compared<Relation::less>(a.lanes[r], b.lanes[r]); });
  }
  friend Mask operator<=(const ValvePack& a, const ValvePack& b) {
    return each_register<Mask>(
        [&](std::size_t r) { return compared<Relation::less_or_equal>(a.lanes[r], b.lanes[r]); });
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
      [&](std::size_t r) { return blended<Register>(condition.lanes[r], yes.lanes[r], no.lanes[r]); });
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

namespace detail {

/// Where in a state that is made of packs masks lie whose answers are bits, counted in registers.
template <class State, std::size_t registers>
struct MaskPlaces {
  std::array<bool, registers> holds{};
  std::size_t at = 0;  ///< in bytes

  template <class Member>
  constexpr void look_at(Member& member) {
    at = (at + alignof(Member) - 1) / alignof(Member) * alignof(Member);
    const std::size_t begun = at;
    if constexpr (numerics::detail::is_array<Member>) {
      // of packs, as a rule: an array of masks would be told by its size
    } else if constexpr (requires { Member::answers_are_bits; }) {
      holds[at * registers / sizeof(State)] = Member::answers_are_bits;
    } else if constexpr (numerics::Structure<Member>) {
      numerics::for_each_member(member, [this](auto& part) { this->look_at(part); });
    }
    at = begun + sizeof(Member);
  }
};

template <class State, std::size_t registers>
constexpr std::array<bool, registers> mask_places() {
  union Memory {
    char none;
    State state;
    constexpr Memory() : none{} {}
  } memory;
  MaskPlaces<State, registers> places;
  places.look_at(memory.state);
  return places.holds;
}

}  // namespace detail

/// Of `kept`, what belongs to the valves of `condition`, in place of what `out` has. Both are made of packs and nothing
/// else, one number a valve each; or of masks, of which several may lie in the place of one register.
template <class Register, int Count, class Packs>
void keep(const PackMask<Register, Count>& condition, const Packs& kept, Packs& out) {
  static_assert(sizeof(Packs) % sizeof(Register) == 0 && std::is_trivially_copyable_v<Packs>);
  constexpr std::size_t registers = sizeof(Packs) / sizeof(Register);
  const auto take = [&](std::size_t k, const auto& blend) __attribute__((always_inline)) {
    Register old, now;
    std::memcpy(&old, reinterpret_cast<const char*>(&kept) + k * sizeof(Register), sizeof(Register));
    std::memcpy(&now, reinterpret_cast<const char*>(&out) + k * sizeof(Register), sizeof(Register));
    now = blend(condition.lanes[k % Count], old, now);
    std::memcpy(reinterpret_cast<char*>(&out) + k * sizeof(Register), &now, sizeof(Register));
  };
  constexpr std::array<bool, registers> masks = detail::mask_places<Packs, registers>();
  if constexpr (std::ranges::find(masks, true) != masks.end()) {
    [&]<std::size_t... k>(std::index_sequence<k...>) __attribute__((always_inline)) {
      (take(k, masks[k] ? blended_masks<Register> : blended<Register>), ...);
    }
    (std::make_index_sequence<registers>());
  } else {
    for (std::size_t k = 0; k < registers; ++k) take(k, blended<Register>);
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
  if constexpr (sizeof(State) <= 16 * sizeof(ValvePack<Register, Count>)) {
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

/// Of sixteen valves one copy and one taking over for both, of fewer one after the other: each was the faster
/// (docs/batch.md).
template <class Register, int Count, class State, class Yes, class No>
[[gnu::always_inline]] inline void in_either(const PackMask<Register, Count>& condition, State& state, const Yes& yes,
                                             const No& no) {
  if constexpr (compares_to_bits<Register>) {
    const bool some = any(condition);
    Copy<State> other;
    if (some) {
      other.packs = state;
      yes(other.packs);
    }
    if (any(!condition)) no(state);
    if (some) keep(condition, other.packs, state);
  } else {
    in_valves(!condition, state, [&] { no(state); });
    in_valves(condition, state, [&] { yes(state); });
  }
}

}  // namespace spoolflow::estimation::packs

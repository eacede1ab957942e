#pragma once
/// Status words of several valves.
#include "spoolflow/estimation/packs/valve_pack.hpp"

namespace spoolflow::estimation::packs {

/// Status words.
template <class Register, int Count>
struct PackStatus {
  PackIndex<Register, Count> words;

  friend PackStatus operator|(const PackStatus& a, const PackStatus& b) {
    using Index = PackIndex<Register, Count>;
    return {each_register<Index>([&](std::size_t r) { return a.words.lanes[r] | b.words.lanes[r]; })};
  }
};

/// Which valves have any bit.
template <class Register, int Count>
PackMask<Register, Count> is_any(const PackStatus<Register, Count>& status) {
  return !(status.words == 0);
}

template <class Register, int Count>
PackStatus<Register, Count> when(const PackMask<Register, Count>& condition, sensor::Status bit) {
  using Index = PackIndex<Register, Count>;
  const typename Index::Integers bits(typename Index::Integer{static_cast<std::int32_t>(bit)});
  return {each_register<Index>([&](std::size_t r) { return only<Register>(condition.lanes[r], bits); })};
}

template <class Register, int Count>
void mark(PackStatus<Register, Count>& status, const PackMask<Register, Count>& condition, sensor::Status bit) {
  status = status | when(condition, bit);
}

}  // namespace spoolflow::estimation::packs

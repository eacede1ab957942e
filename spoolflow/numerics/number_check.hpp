#pragma once
/// Whether what was copied from bytes holds numbers that can be calculated with.
#include <cmath>
#include <cstring>
#include <type_traits>

#include "spoolflow/numerics/members.hpp"

namespace spoolflow::numerics {

/// No number of a state is larger, whatever its unit.
inline constexpr double largest_kept_number = 1e30;

/// Whether a bool that was copied from bytes is one; any other byte must never be read as a bool.
inline bool is_bool(const bool& member) {
  unsigned char byte = 0;
  std::memcpy(&byte, &member, 1);
  return byte <= 1;
}

/// Every floating number in it is finite and at most largest_kept_number in size, every bool is one.
template <class State>
[[nodiscard]] bool holds_numbers(const State& state) {
  bool sound = true;
  for_each_number(state, [&sound](const auto& number) {
    using Number = std::remove_cvref_t<decltype(number)>;
    if constexpr (std::is_floating_point_v<Number>) sound = sound && std::abs(number) <= Number(largest_kept_number);
    if constexpr (std::is_same_v<Number, bool>) sound = sound && is_bool(number);
  });
  return sound;
}

}  // namespace spoolflow::numerics

#pragma once
/// The bytes between the members of an object, which hold whatever lay there before.
#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "spoolflow/numerics/members.hpp"

namespace spoolflow::numerics {

/// They become zero; the members stay. Not by the compiler's own means: GCC 12's __builtin_clear_padding takes an array
/// of structures without padding for nothing, and clears members behind it.
template <class Object>
void clear_padding(Object& object) {
  static_assert(std::is_trivially_copyable_v<Object>);
  std::array<std::byte, sizeof(Object)> members{};
  const auto* const begin = reinterpret_cast<const std::byte*>(&object);
  for_each_number(object, [&](const auto& number) {
    const auto* const at = reinterpret_cast<const std::byte*>(&number);
    std::memcpy(members.data() + (at - begin), at, sizeof number);
  });
  std::memcpy(static_cast<void*>(&object), members.data(), sizeof object);
}

}  // namespace spoolflow::numerics

#pragma once
/// Bytes of objects that are no value.
#include <cstring>

namespace spoolflow::exports {

/// The bytes between the members become zero, where the compiler knows how; others leave them as they are.
template <class Object>
void clear_padding([[maybe_unused]] Object& object) {
#if defined(__has_builtin)
#if __has_builtin(__builtin_clear_padding)
  __builtin_clear_padding(&object);
#endif
#endif
}

/// Whether a bool that was copied from bytes is one; any other byte must never be read as a bool.
inline bool is_bool(const bool& member) {
  unsigned char byte = 0;
  std::memcpy(&byte, &member, 1);
  return byte <= 1;
}

}  // namespace spoolflow::exports

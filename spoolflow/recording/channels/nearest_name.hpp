#pragma once
/// Which known name somebody may have meant.
#include <string_view>

namespace spoolflow::recording {

/// Steps from one word to the other: insert, delete, replace a letter, or swap two neighbours.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The first name of `known`, which must hold one, that is fewest steps away.
template <class Names>
[[nodiscard]] std::string_view nearest_name(std::string_view name, const Names& known) {
  std::string_view nearest = *known.begin();
  for (const auto& candidate : known) {
    if (edit_distance(name, candidate) < edit_distance(name, nearest)) nearest = candidate;
  }
  return nearest;
}

}  // namespace spoolflow::recording

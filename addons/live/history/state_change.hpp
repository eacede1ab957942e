#pragma once
/// What differs between two states of one length: of a valve's sensor and monitor little does from second to second,
/// and only that is written.
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace spoolflow::live {

/// The words of 8 bytes in which `now` differs from `before`, which is as long or empty: all zero. In runs: how many
/// words stay, how many change (both as LEB128 numbers), and these words; a rest of less than 8 bytes is a word, too.
[[nodiscard]] std::vector<std::byte> state_change(std::span<const std::byte> before, std::span<const std::byte> now);

/// Makes `now` of `before`. Returns false where the change is none of a state of this length; the state is then
/// worthless.
[[nodiscard]] bool apply_change(std::span<const std::byte> change, std::span<std::byte> state);

/// The changes of all valves, by their numbers in the store, as one piece: small pieces would waste the rest of a page.
using StateChanges = std::map<std::int64_t, std::vector<std::byte>>;
[[nodiscard]] std::vector<std::byte> joined(const StateChanges& changes);
/// What is damaged is left out.
[[nodiscard]] StateChanges parted(std::span<const std::byte> joined);

}  // namespace spoolflow::live

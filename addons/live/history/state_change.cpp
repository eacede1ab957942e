#include "addons/live/history/state_change.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>

namespace spoolflow::live {
namespace {

constexpr std::size_t word_bytes = 8;

std::size_t words_in(std::size_t bytes) {
  return (bytes + word_bytes - 1) / word_bytes;
}

void put_number(std::vector<std::byte>& out, std::size_t value) {
  for (; value >= 0x80; value >>= 7U) out.push_back(static_cast<std::byte>(value & 0x7FU) | std::byte{0x80});
  out.push_back(static_cast<std::byte>(value));
}

/// The number at the front, which is taken off; nothing where none is whole.
std::optional<std::size_t> take_number(std::span<const std::byte>& from) {
  std::size_t value = 0;
  for (unsigned shift = 0; shift < 63 && !from.empty(); shift += 7) {
    const std::byte next = from.front();
    from = from.subspan(1);
    value |= static_cast<std::size_t>(next & std::byte{0x7F}) << shift;
    if ((next & std::byte{0x80}) == std::byte{0}) return value;
  }
  return std::nullopt;
}

}  // namespace

std::vector<std::byte> state_change(std::span<const std::byte> before, std::span<const std::byte> now) {
  const std::size_t words = words_in(now.size());
  const auto word_of = [&](std::span<const std::byte> state, std::size_t word) {
    std::uint64_t out = 0;
    const std::size_t at = word * word_bytes;
    std::memcpy(&out, state.data() + at, now.size() - at >= word_bytes ? word_bytes : now.size() - at);
    return out;
  };
  const auto changes = [&](std::size_t word) {
    return word_of(now, word) != (before.empty() ? 0 : word_of(before, word));
  };
  std::vector<std::byte> out;
  for (std::size_t word = 0; word < words;) {
    const std::size_t stays_from = word;
    while (word < words && !changes(word)) ++word;
    if (word == words) break;
    const std::size_t from = word;
    while (word < words && changes(word)) ++word;
    put_number(out, from - stays_from);
    put_number(out, word - from);
    const auto run = now.subspan(from * word_bytes, std::min(word * word_bytes, now.size()) - from * word_bytes);
    out.insert(out.end(), run.begin(), run.end());
  }
  return out;
}

bool apply_change(std::span<const std::byte> change, std::span<std::byte> state) {
  const std::size_t words = words_in(state.size());
  for (std::size_t word = 0; !change.empty();) {
    const auto stay = take_number(change);
    const auto differ = take_number(change);
    if (!stay || !differ || *stay > words - word || *differ > words - word - *stay) return false;
    const std::size_t from = (word + *stay) * word_bytes;
    word += *stay + *differ;
    const std::size_t length = std::min(word * word_bytes, state.size()) - std::min(from, state.size());
    if (length > change.size()) return false;
    std::copy_n(change.begin(), length, state.begin() + static_cast<std::ptrdiff_t>(std::min(from, state.size())));
    change = change.subspan(length);
  }
  return true;
}

std::vector<std::byte> joined(const StateChanges& changes) {
  std::vector<std::byte> out;
  for (const auto& [valve, change] : changes) {
    put_number(out, static_cast<std::size_t>(valve));
    put_number(out, change.size());
    out.insert(out.end(), change.begin(), change.end());
  }
  return out;
}

StateChanges parted(std::span<const std::byte> joined) {
  StateChanges out;
  while (!joined.empty()) {
    const auto valve = take_number(joined);
    const auto length = take_number(joined);
    if (!valve || !length || *length > joined.size()) break;
    out[static_cast<std::int64_t>(*valve)].assign(joined.begin(),
                                                  joined.begin() + static_cast<std::ptrdiff_t>(*length));
    joined = joined.subspan(*length);
  }
  return out;
}

}  // namespace spoolflow::live

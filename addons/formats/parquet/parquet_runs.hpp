#pragma once
/// Small whole numbers as Parquet's runs ("RLE" of its hybrid encoding): how often, then which.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace spoolflow::recording {

/// Appends the runs of `count` numbers `at(k)`, each of at most `bits` bits.
template <class At>
void put_runs(std::vector<std::uint8_t>& bytes, std::size_t count, unsigned bits, At&& at) {
  for (std::size_t from = 0; from < count;) {
    const auto value = static_cast<std::uint32_t>(at(from));
    std::size_t to = from + 1;
    while (to < count && static_cast<std::uint32_t>(at(to)) == value) ++to;
    std::uint64_t head = static_cast<std::uint64_t>(to - from) << 1U;  // a last bit of 0: a run
    for (; head >= 0x80; head >>= 7U) bytes.push_back(static_cast<std::uint8_t>(head | 0x80U));
    bytes.push_back(static_cast<std::uint8_t>(head));
    for (unsigned shift = 0; shift < bits; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
    from = to;
  }
}

}  // namespace spoolflow::recording

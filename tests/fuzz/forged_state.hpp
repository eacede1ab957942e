#pragma once
/// A kept state whose bytes were changed, and whose checksum holds nevertheless.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "spoolflow/export/state_bytes.hpp"
#include "tests/fuzz/odd_number.hpp"

namespace spoolflow::fuzz {

/// None to three of its numbers or bytes; now and then it is cut short or too long. Whether it is another state now:
/// plausible hidden numbers that no sample led to make answers that none would.
inline bool forge_state(Input& in, std::vector<char>& state) {
  const std::vector<char> kept = state;
  constexpr std::size_t header = sizeof(exports::StateHeader);
  if (state.size() > header) {
    const std::size_t numbers = (state.size() - header) / sizeof(double);
    for (std::size_t changes = in.byte() % 4; changes > 0; --changes) {
      char* const number = state.data() + header + sizeof(double) * in.below(numbers);
      const std::uint8_t kind = in.byte();
      if (kind % 2 == 0) {
        number[kind / 2 % sizeof(double)] = static_cast<char>(in.byte());
      } else {
        const double extreme = in.number(1, 1);
        std::memcpy(number, &extreme, sizeof extreme);
      }
    }
    const std::uint64_t sum = spoolflow::numerics::checksum(state.data() + header, state.size() - header);
    std::memcpy(state.data() + offsetof(exports::StateHeader, checksum), &sum, sizeof sum);
  }
  if (in.byte() % 8 == 0) state.resize(in.below(state.size() + 2));
  return state != kept;
}

}  // namespace spoolflow::fuzz

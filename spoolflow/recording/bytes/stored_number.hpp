#pragma once
/// How measurement files store numbers, and as what they are read.
#include <cstddef>
#include <cstdint>

#include "spoolflow/recording/bytes/byte_reader.hpp"

namespace spoolflow::recording {

struct StoredNumber {
  enum class Kind : std::uint8_t { unsigned_whole, signed_whole, real };
  Kind kind = Kind::real;
  std::uint8_t bytes = 8;  ///< 1, 2, 4, 8 of whole numbers; 2, 4, 8 of real ones
  ByteOrder order = ByteOrder::lowest_first;

  bool operator==(const StoredNumber&) const = default;
};

/// `count` numbers, the first at `from`, each `stride` bytes behind the one before; all of them must be there.
void read_numbers(const StoredNumber& stored, const std::uint8_t* from, std::size_t stride, std::size_t count,
                  double* out);

}  // namespace spoolflow::recording

#pragma once
/// One channel's numbers within the records of an MDF 4 file.
#include <cstdint>
#include <optional>
#include <string>

#include "spoolflow/recording/bytes/stored_number.hpp"

namespace spoolflow::recording {

struct Mdf4Sample {
  StoredNumber number{};   ///< its kind and byte order; its width is that of `bits`
  std::uint32_t byte = 0;  ///< within the record, behind its number
  std::uint32_t bit = 0, bits = 0;
  bool by_index = false;                       ///< virtual: the number of the record itself
  std::optional<std::uint32_t> invalid_bit{};  ///< of the record, counted from its first byte

  /// Bytes from `byte` on that hold it.
  [[nodiscard]] std::uint32_t span() const { return (bit + bits + 7) / 8; }
  /// NaN where the record says that it is invalid. `record`: without its number; all its bytes must be there.
  [[nodiscard]] double read(const std::uint8_t* record, std::uint64_t index) const;
};

/// How a channel of that type (cn_data_type) is stored; nothing, and why in `unread`, where it is no number.
[[nodiscard]] std::optional<Mdf4Sample> mdf4_sample(std::uint8_t type, std::uint32_t byte, std::uint8_t bit,
                                                    std::uint32_t bits, std::string& unread);

}  // namespace spoolflow::recording

#pragma once
#include <cstdint>
#include <optional>

#include "spoolflow/recording/bytes/stored_number.hpp"

namespace spoolflow::recording {

/// Types of TDMS values by their number in the file.
enum class TdmsType : std::uint32_t {
  nothing = 0,
  i8 = 1,
  i16 = 2,
  i32 = 3,
  i64 = 4,
  u8 = 5,
  u16 = 6,
  u32 = 7,
  u64 = 8,
  single = 9,
  real = 10,
  extended = 11,
  single_with_unit = 0x19,
  real_with_unit = 0x1A,
  extended_with_unit = 0x1B,
  text = 0x20,
  boolean = 0x21,
  time = 0x44,
  complex_single = 0x08000C,
  complex_real = 0x10000D,
  daqmx = 0xFFFFFFFF
};

/// Of types that are one number each; nothing for the others.
[[nodiscard]] std::optional<StoredNumber> stored_number(TdmsType type, ByteOrder order);

/// Of the types in DAQmx' own numbering, from 0: u8, i8, u16, i16, u32, i32, u64, i64, single, real.
[[nodiscard]] std::optional<StoredNumber> stored_daqmx_number(std::uint32_t type, ByteOrder order);

/// Of types with a fixed width; 0 of texts and of types that are not known.
[[nodiscard]] std::uint32_t bytes_of(TdmsType type);

}  // namespace spoolflow::recording

#include "spoolflow/recording/tdms/tdms_type.hpp"

#include <array>

namespace spoolflow::recording {

using Kind = StoredNumber::Kind;

std::optional<StoredNumber> stored_number(TdmsType type, ByteOrder order) {
  switch (type) {
    case TdmsType::i8:
    case TdmsType::i16:
    case TdmsType::i32:
    case TdmsType::i64:
      return StoredNumber{Kind::signed_whole, static_cast<std::uint8_t>(bytes_of(type)), order};
    case TdmsType::u8:
    case TdmsType::u16:
    case TdmsType::u32:
    case TdmsType::u64:
    case TdmsType::boolean:
      return StoredNumber{Kind::unsigned_whole, static_cast<std::uint8_t>(bytes_of(type)), order};
    case TdmsType::single:
    case TdmsType::single_with_unit:
    case TdmsType::real:
    case TdmsType::real_with_unit:
      return StoredNumber{Kind::real, static_cast<std::uint8_t>(bytes_of(type)), order};
    default:
      return std::nullopt;
  }
}

std::optional<StoredNumber> stored_daqmx_number(std::uint32_t type, ByteOrder order) {
  constexpr std::array<TdmsType, 10> types{TdmsType::u8,     TdmsType::i8,  TdmsType::u16, TdmsType::i16,
                                           TdmsType::u32,    TdmsType::i32, TdmsType::u64, TdmsType::i64,
                                           TdmsType::single, TdmsType::real};
  if (type >= types.size()) return std::nullopt;
  return stored_number(types[type], order);
}

std::uint32_t bytes_of(TdmsType type) {
  switch (type) {
    case TdmsType::i8:
    case TdmsType::u8:
    case TdmsType::boolean:
      return 1;
    case TdmsType::i16:
    case TdmsType::u16:
      return 2;
    case TdmsType::i32:
    case TdmsType::u32:
    case TdmsType::single:
    case TdmsType::single_with_unit:
      return 4;
    case TdmsType::i64:
    case TdmsType::u64:
    case TdmsType::real:
    case TdmsType::real_with_unit:
    case TdmsType::complex_single:
      return 8;
    case TdmsType::extended:
    case TdmsType::extended_with_unit:
    case TdmsType::time:
    case TdmsType::complex_real:
      return 16;
    default:
      return 0;
  }
}

}  // namespace spoolflow::recording

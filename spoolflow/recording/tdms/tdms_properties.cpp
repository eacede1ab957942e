#include "spoolflow/recording/tdms/tdms_properties.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/tdms/tdms_type.hpp"

namespace spoolflow::recording {
namespace {

bool is_asked_for(const std::string& name) {
  return name.starts_with("wf_") || name == "unit_string" || name.starts_with("NI_");
}

}  // namespace

double TdmsTime::since(const TdmsTime& origin) const {
  constexpr double share = 0x1p-64;
  // In unsigned numbers, whose overflow is defined: what no file of sense holds gives some number.
  const auto seconds =
      static_cast<std::int64_t>(static_cast<std::uint64_t>(second) - static_cast<std::uint64_t>(origin.second));
  return static_cast<double>(seconds) + (static_cast<double>(fraction) - static_cast<double>(origin.fraction)) * share;
}

TdmsTime read_tdms_time(ByteReader& bytes, ByteOrder order) {
  TdmsTime out;
  if (order == ByteOrder::highest_first) {
    out.second = static_cast<std::int64_t>(bytes.u64());
    out.fraction = bytes.u64();
  } else {
    out.fraction = bytes.u64();
    out.second = static_cast<std::int64_t>(bytes.u64());
  }
  return out;
}

void TdmsProperties::read(ByteReader& bytes, ByteOrder order, const std::string& what) {
  for (std::uint32_t left = bytes.u32(); left > 0; --left) {
    const std::string name(bytes.text(bytes.u32()));
    const auto type = static_cast<TdmsType>(bytes.u32());
    Value value;
    if (type == TdmsType::text) {
      value = std::string(bytes.text(bytes.u32()));
    } else if (type == TdmsType::time) {
      value = read_tdms_time(bytes, order);
    } else if (const auto stored = stored_number(type, order)) {
      const std::string_view from = bytes.text(stored->bytes);
      double number = 0;
      read_numbers(*stored, reinterpret_cast<const std::uint8_t*>(from.data()), 0, 1, &number);
      value = number;
    } else if (bytes_of(type) > 0) {
      bytes.skip(bytes_of(type));
      continue;
    } else if (type != TdmsType::nothing) {
      throw RecordingError(
          fmt::format("{}: the property '{}' is of type {:#x}, which is not known; it is damaged, "
                      "copy or record it again",
                      what, name, static_cast<std::uint32_t>(type)));
    }
    if (is_asked_for(name)) values_.insert_or_assign(name, std::move(value));
  }
}

}  // namespace spoolflow::recording

#include "spoolflow/recording/bytes/byte_reader.hpp"

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {

std::uint64_t ByteReader::whole(std::size_t bytes) {
  const std::string_view from = text(bytes);
  std::uint64_t value = 0;
  for (std::size_t k = 0; k < bytes; ++k) {
    const std::size_t at = order_ == ByteOrder::highest_first ? k : bytes - 1 - k;
    value = value << 8U | static_cast<std::uint8_t>(from[at]);
  }
  return value;
}

std::string_view ByteReader::text(std::uint64_t bytes) {
  if (bytes > rest_.size()) {
    throw RecordingError(
        fmt::format("{} ends too soon: {} bytes are needed where {} are left; it is damaged, copy or record it again",
                    what_, bytes, rest_.size()));
  }
  const auto count = static_cast<std::size_t>(bytes);
  const std::string_view out(reinterpret_cast<const char*>(rest_.data()), count);
  rest_ = rest_.subspan(count);
  return out;
}

}  // namespace spoolflow::recording

#pragma once
/// Records of MCAP (mcap.dev, specification version 0): an opcode, a length, the content.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "spoolflow/numerics/little_endian.hpp"

namespace spoolflow::recording {

enum class McapRecord : std::uint8_t {
  header = 1,
  footer = 2,
  schema = 3,
  channel = 4,
  message = 5,
  chunk = 6,
  message_index = 7,
  chunk_index = 8,
  statistics = 11,
  metadata = 12,
  metadata_index = 13,
  summary_offset = 14,
  data_end = 15,
};

inline constexpr std::string_view mcap_magic = "\x89MCAP0\r\n";

/// The content of a record, field by field.
class McapContent {
 public:
  template <class N>
  McapContent& number(N value) {
    numerics::put_little_endian(bytes_, value);
    return *this;
  }
  McapContent& text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    return bare({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  McapContent& texts(const std::vector<std::pair<std::string, std::string>>& by_key) {
    McapContent inside;
    for (const auto& [key, value] : by_key) inside.text(key).text(value);
    return number(static_cast<std::uint32_t>(inside.bytes_.size())).bare(inside.bytes_);
  }
  McapContent& bare(std::span<const std::uint8_t> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  /// Keeps the memory.
  void clear() { bytes_.clear(); }
  [[nodiscard]] const std::vector<std::uint8_t>& bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

inline void put_record(std::vector<std::uint8_t>& bytes, McapRecord kind, const McapContent& content) {
  bytes.push_back(static_cast<std::uint8_t>(kind));
  numerics::put_little_endian(bytes, static_cast<std::uint64_t>(content.bytes().size()));
  bytes.insert(bytes.end(), content.bytes().begin(), content.bytes().end());
}

}  // namespace spoolflow::recording

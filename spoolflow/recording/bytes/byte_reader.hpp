#pragma once
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace spoolflow::recording {

enum class ByteOrder : std::uint8_t { lowest_first, highest_first };

/// Numbers and texts one after the other out of bytes, none of which is trusted: each call throws RecordingError
/// where fewer bytes are left than it needs.
class ByteReader {
 public:
  /// `what`: "run.tdms: the metadata of the segment at byte 0", for messages; it must outlive the reader.
  ByteReader(std::span<const std::uint8_t> bytes, ByteOrder order, const std::string& what)
      : rest_(bytes), order_(order), what_(what) {}

  [[nodiscard]] std::uint8_t u8() { return static_cast<std::uint8_t>(whole(1)); }
  [[nodiscard]] std::uint16_t u16() { return static_cast<std::uint16_t>(whole(2)); }
  [[nodiscard]] std::uint32_t u32() { return static_cast<std::uint32_t>(whole(4)); }
  [[nodiscard]] std::uint64_t u64() { return whole(8); }
  [[nodiscard]] double f64() { return std::bit_cast<double>(whole(8)); }
  /// A whole number of 1 to 8 bytes.
  [[nodiscard]] std::uint64_t whole(std::size_t bytes);
  /// As it stands there; valid as long as the bytes are.
  [[nodiscard]] std::string_view text(std::uint64_t bytes);
  void skip(std::uint64_t bytes) { (void)text(bytes); }
  [[nodiscard]] std::size_t left() const { return rest_.size(); }

 private:
  std::span<const std::uint8_t> rest_;
  ByteOrder order_;
  const std::string& what_;
};

}  // namespace spoolflow::recording

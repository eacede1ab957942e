#pragma once
/// Structures in Apache Thrift's compact protocol, as Parquet's footer and page heads are written.
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace spoolflow::recording {

class ThriftCompact {
 public:
  enum class Kind : std::uint8_t { number = 5, long_number = 6, text = 8, list = 9, structure = 12 };

  /// Fields in rising order of their ids.
  void number(int id, std::int32_t value) { field(id, Kind::number), zigzag(value); }
  void long_number(int id, std::int64_t value) { field(id, Kind::long_number), zigzag(value); }
  void text(int id, std::string_view value) { field(id, Kind::text), bare_text(value); }
  void begin_structure(int id) { field(id, Kind::structure), begin_element(); }
  /// `count` elements follow: structures between begin_element() and end(), bare texts or bare numbers.
  void begin_list(int id, std::size_t count, Kind kind) {
    field(id, Kind::list);
    const auto type = static_cast<std::uint8_t>(kind);
    if (count < 15) {
      bytes_.push_back(static_cast<std::uint8_t>(count << 4U | type));
    } else {
      bytes_.push_back(static_cast<std::uint8_t>(0xF0U | type));
      varint(count);
    }
  }
  void begin_element() { last_ids_.push_back(0); }
  void end() {
    last_ids_.pop_back();
    bytes_.push_back(0);
  }
  void bare_number(std::int32_t value) { zigzag(value); }
  void bare_text(std::string_view value) {
    varint(value.size());
    bytes_.insert(bytes_.end(), value.begin(), value.end());
  }
  /// The whole structure.
  [[nodiscard]] std::vector<std::uint8_t> finished() {
    bytes_.push_back(0);
    return std::move(bytes_);
  }

 private:
  void field(int id, Kind kind) {
    const int step = id - last_ids_.back();
    last_ids_.back() = id;
    bytes_.push_back(static_cast<std::uint8_t>(static_cast<unsigned>(step) << 4U | static_cast<std::uint8_t>(kind)));
  }
  void varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7U) bytes_.push_back(static_cast<std::uint8_t>(value | 0x80U));
    bytes_.push_back(static_cast<std::uint8_t>(value));
  }
  void zigzag(std::int64_t value) {
    varint(static_cast<std::uint64_t>(value) << 1U ^ static_cast<std::uint64_t>(value >> 63));
  }

  std::vector<std::uint8_t> bytes_;
  std::vector<int> last_ids_{0};
};

}  // namespace spoolflow::recording

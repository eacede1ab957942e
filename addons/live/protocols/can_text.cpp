#include "addons/live/protocols/can_text.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <ctime>

#include <fmt/chrono.h>
#include <fmt/format.h>

namespace spoolflow::fieldbus {
namespace {

using sensor::CanFrame;

std::string hex_bytes(const CanFrame& frame, const char* between) {
  std::string out;
  for (unsigned k = 0; k < frame.size; ++k) {
    if (k > 0) out += between;
    out += fmt::format("{:02X}", frame.data[k]);
  }
  return out;
}

std::string asc_date(double time_s) {
  const auto seconds = static_cast<std::time_t>(std::floor(time_s));
  const std::tm utc = fmt::gmtime(seconds);
  const auto ms = static_cast<int>(std::floor((time_s - static_cast<double>(seconds)) * 1000));
  return fmt::format("{:%a %b %d %I:%M:%S}.{:03} {:%p %Y}", utc, ms, utc);
}

// MessagePack, as far as such a datagram needs it.
void put_text(std::string& out, std::string_view text) {
  out += static_cast<char>(0xA0U | text.size());  // up to 31 bytes
  out += text;
}
void put_big_endian(std::string& out, std::uint64_t bits, int bytes) {
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
    out += static_cast<char>(bits >> static_cast<unsigned>(shift));
}

/// One value after the other of a map whose values are flags, numbers, nil, short texts and bytes.
class MapReader {
 public:
  explicit MapReader(std::string_view bytes) : rest_(bytes) {}
  [[nodiscard]] bool failed() const { return failed_; }
  std::size_t entries() {
    const unsigned kind = byte();
    if ((kind & 0xF0U) == 0x80U) return kind & 0x0FU;
    if (kind == 0xDEU) return static_cast<std::size_t>(number(2));
    failed_ = true;
    return 0;
  }
  struct Value {
    std::uint64_t number = 0;
    std::string_view bytes{};
  };
  Value value() {
    const unsigned kind = byte();
    if (kind < 0x80U) return {kind, {}};
    if ((kind & 0xE0U) == 0xA0U) return {0, taken(kind & 0x1FU)};
    switch (kind) {
      case 0xC0U:
      case 0xC2U:
        return {};
      case 0xC3U:
        return {1, {}};
      case 0xC4U:
      case 0xD9U:
        return {0, taken(static_cast<std::size_t>(number(1)))};
      case 0xCCU:
        return {number(1), {}};
      case 0xCDU:
        return {number(2), {}};
      case 0xCAU:
      case 0xCEU:
        return {number(4), {}};
      case 0xCBU:
      case 0xCFU:
        return {number(8), {}};
      default:
        failed_ = true;
        return {};
    }
  }

 private:
  unsigned byte() {
    const std::string_view one = taken(1);
    return one.empty() ? 0U : static_cast<unsigned char>(one[0]);
  }
  std::uint64_t number(int bytes) {
    std::uint64_t out = 0;
    for (const char one : taken(static_cast<std::size_t>(bytes))) out = out << 8U | static_cast<unsigned char>(one);
    return out;
  }
  std::string_view taken(std::size_t bytes) {
    if (bytes > rest_.size()) {
      failed_ = true;
      return {};
    }
    const std::string_view out = rest_.substr(0, bytes);
    rest_.remove_prefix(bytes);
    return out;
  }
  std::string_view rest_;
  bool failed_ = false;
};

}  // namespace

std::string candump_line(const CanFrame& frame, double time_s, std::string_view interface) {
  return fmt::format("({:.6f}) {} {:0{}X}#{}\n", time_s, interface, frame.id, frame.extended ? 8 : 3,
                     hex_bytes(frame, ""));
}

std::string asc_beginning(double start_s) {
  const std::string date = asc_date(start_s);
  return fmt::format(
      "date {}\nbase hex  timestamps absolute\ninternal events logged\nBegin Triggerblock {}\n 0.000000 Start of "
      "measurement\n",
      date, date);
}

std::string asc_line(const CanFrame& frame, double since_start_s) {
  return fmt::format("{:9.6f} 1  {:<15} Tx   d {:x} {}\n", since_start_s,
                     fmt::format("{:X}{}", frame.id, frame.extended ? "x" : ""), frame.size, hex_bytes(frame, " "));
}

std::string can_datagram(const CanFrame& frame, double time_s) {
  constexpr char no = '\xC2', yes = '\xC3', nil = '\xC0';
  std::string out(1, '\x8B');  // eleven entries
  const auto put_flag = [&](std::string_view name, char value) {
    put_text(out, name);
    out += value;
  };
  put_text(out, "timestamp");
  out += '\xCB';
  put_big_endian(out, std::bit_cast<std::uint64_t>(time_s), 8);
  put_text(out, "arbitration_id");
  out += '\xCE';
  put_big_endian(out, frame.id, 4);
  put_flag("is_extended_id", frame.extended ? yes : no);
  put_flag("is_remote_frame", no);
  put_flag("is_error_frame", no);
  put_flag("channel", nil);
  put_flag("dlc", static_cast<char>(frame.size));
  put_text(out, "data");
  out += '\xC4';
  out += static_cast<char>(frame.size);
  for (unsigned k = 0; k < frame.size; ++k) out += static_cast<char>(frame.data[k]);
  put_flag("is_fd", no);
  put_flag("bitrate_switch", no);
  put_flag("error_state_indicator", no);
  return out;
}

std::optional<CanFrame> read_can_datagram(std::string_view bytes) {
  MapReader map(bytes);
  CanFrame out;
  bool has_id = false, is_other = false;
  for (std::size_t left = map.entries(); left > 0 && !map.failed(); --left) {
    const std::string_view key = map.value().bytes;
    const MapReader::Value value = map.value();
    if (key == "arbitration_id") {
      has_id = value.number < 1U << 29U;
      out.id = static_cast<std::uint32_t>(value.number);
    } else if (key == "is_extended_id") {
      out.extended = value.number != 0;
    } else if (key == "data") {
      if (value.bytes.size() > out.data.size()) return std::nullopt;
      out.size = static_cast<std::uint8_t>(value.bytes.size());
      std::copy(value.bytes.begin(), value.bytes.end(), out.data.begin());
    } else if (key == "is_remote_frame" || key == "is_error_frame" || key == "is_fd") {
      is_other = is_other || value.number != 0;
    }
  }
  if (map.failed() || !has_id || is_other) return std::nullopt;
  return out;
}

}  // namespace spoolflow::fieldbus

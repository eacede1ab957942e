#pragma once
/// Samples of a valve in a UDP datagram. All numbers are little endian.
///
///     byte  bytes
///        0      4  the letters "SFLW"
///        4      1  version, 1
///        5      1  nothing, 0
///        6      2  channels of each sample, at least one: one bit each (datagram_channels), in the order of their bits
///        8      4  session: any number that the sender changes when its sequence numbers begin at 0 again
///       12      2  samples, at least 1
///       14      2  nothing, 0
///       16      8  sequence number of the first sample: samples sent before it in this session
///       24      8  time of the first sample [ns], of the sender's clock, signed; it never runs back
///       32      4  sampling period [ns], at least 1
///       36     32  the valve's id in UTF-8, filled up with zero bytes
///       68   4n*c  n samples of c channels, each a 32-bit IEEE 754 number in SI units; NaN: not measured now
///   68+4nc      4  CRC-32 (IEEE 802.3, as in zlib) of all bytes before
///
/// Up to 1472 bytes go through an Ethernet unbroken; 65507 are the most that UDP has.
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::live {

inline constexpr std::size_t datagram_header_bytes = 68;
inline constexpr std::size_t datagram_checksum_bytes = 4;
inline constexpr std::size_t largest_datagram = 65507;
inline constexpr std::size_t longest_valve_id = 32;

/// A channel of a datagram; its index in the table is its bit.
struct DatagramChannel {
  const char* name;
  double estimation::TimedSample::*member;  ///< null: a port pressure
  double sensor::PortPressures<double>::*port;
};
/// current_A is that of solenoid b where current_a_A is sent as well.
inline constexpr std::array<DatagramChannel, 10> datagram_channels{{
    {"current_A", &estimation::TimedSample::current_A, nullptr},
    {"voltage_V", &estimation::TimedSample::voltage_V, nullptr},
    {"position_m", &estimation::TimedSample::position_m, nullptr},
    {"oil_temperature_K", &estimation::TimedSample::oil_temperature_K, nullptr},
    {"current_a_A", &estimation::TimedSample::current_a_A, nullptr},
    {"voltage_a_V", &estimation::TimedSample::voltage_a_V, nullptr},
    {"pressure_p_Pa", nullptr, &sensor::PortPressures<double>::p_Pa},
    {"pressure_a_Pa", nullptr, &sensor::PortPressures<double>::a_Pa},
    {"pressure_b_Pa", nullptr, &sensor::PortPressures<double>::b_Pa},
    {"pressure_t_Pa", nullptr, &sensor::PortPressures<double>::t_Pa},
}};

/// What a datagram says.
struct Datagram {
  std::string valve;
  std::uint32_t session;
  std::uint64_t sequence;
  std::vector<estimation::TimedSample> samples;
};

/// Why bytes are no datagram, for counters and messages.
enum class NoDatagram : std::uint8_t { too_short, no_mark, other_version, wrong_length, wrong_checksum, no_sense };
[[nodiscard]] std::string_view name(NoDatagram reason);

/// Every check before anything is made of the content.
[[nodiscard]] std::variant<Datagram, NoDatagram> read_datagram(std::span<const std::uint8_t> bytes);

/// A sender's side: `channels` are bits of datagram_channels. The id must not be longer than longest_valve_id.
struct DatagramHeader {
  std::string_view valve;
  std::uint32_t session;
  std::uint64_t sequence;
  std::int64_t time_ns;
  std::uint32_t period_ns;
  std::uint16_t channels;
};
[[nodiscard]] std::vector<std::uint8_t> write_datagram(const DatagramHeader& header,
                                                       std::span<const estimation::TimedSample> samples);

}  // namespace spoolflow::live

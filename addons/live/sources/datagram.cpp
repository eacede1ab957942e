#include "addons/live/sources/datagram.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "spoolflow/numerics/crc32.hpp"
#include "spoolflow/numerics/little_endian.hpp"

namespace spoolflow::live {
namespace {

constexpr std::array<std::uint8_t, 4> datagram_mark{'S', 'F', 'L', 'W'};
constexpr std::uint8_t version = 1;
constexpr std::uint16_t known_channels = (1U << datagram_channels.size()) - 1;

using numerics::little_endian;
using numerics::put_little_endian;

double& member(estimation::TimedSample& sample, const DatagramChannel& channel) {
  return channel.member != nullptr ? sample.*channel.member : sample.ports.*channel.port;
}

/// The channels of these bits, in their order.
class ChannelsThere {
 public:
  explicit ChannelsThere(unsigned bits) {
    for (std::size_t bit = 0; bit < datagram_channels.size(); ++bit) {
      if ((bits >> bit & 1U) != 0) channels_[count_++] = &datagram_channels[bit];
    }
  }
  [[nodiscard]] std::span<const DatagramChannel* const> all() const { return {channels_.data(), count_}; }

 private:
  std::array<const DatagramChannel*, datagram_channels.size()> channels_{};
  std::size_t count_ = 0;
};

estimation::TimedSample nothing_measured(double time_s) {
  constexpr double none = estimation::not_measured;
  return {time_s, none, none, none, none, none, none, {none, none, none, none}};
}

}  // namespace

std::string_view name(NoDatagram reason) {
  constexpr std::array<std::string_view, 6> names{"shorter than a header",
                                                  "not begun by SFLW",
                                                  "of another version than 1",
                                                  "of another length than its header says",
                                                  "damaged: its checksum is another",
                                                  "without samples, period, id or known channels"};
  return names[static_cast<std::size_t>(reason)];
}

std::variant<Datagram, NoDatagram> read_datagram(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < datagram_header_bytes + datagram_checksum_bytes) return NoDatagram::too_short;
  if (!std::equal(datagram_mark.begin(), datagram_mark.end(), bytes.begin())) return NoDatagram::no_mark;
  if (bytes[4] != version) return NoDatagram::other_version;
  const auto channels = little_endian<std::uint16_t>(bytes, 6);
  const std::size_t width = static_cast<std::size_t>(std::popcount(channels));
  const std::size_t count = little_endian<std::uint16_t>(bytes, 12);
  const std::size_t body = bytes.size() - datagram_checksum_bytes;
  if (body != datagram_header_bytes + 4 * width * count) return NoDatagram::wrong_length;
  if (numerics::crc32(bytes.first(body)) != little_endian<std::uint32_t>(bytes, body))
    return NoDatagram::wrong_checksum;

  Datagram out;
  const auto id = bytes.subspan(36, longest_valve_id);
  out.valve.assign(id.begin(), std::find(id.begin(), id.end(), std::uint8_t{0}));
  out.session = little_endian<std::uint32_t>(bytes, 8);
  out.sequence = little_endian<std::uint64_t>(bytes, 16);
  const auto time_ns = static_cast<std::int64_t>(little_endian<std::uint64_t>(bytes, 24));
  const auto period_ns = little_endian<std::uint32_t>(bytes, 32);
  const bool counts = out.sequence <= ~std::uint64_t{0} - count;
  if (channels == 0 || count == 0 || period_ns == 0 || out.valve.empty() || !counts ||
      (channels & ~known_channels) != 0) {
    return NoDatagram::no_sense;
  }
  out.samples.reserve(count);
  const ChannelsThere there(channels);
  const bool both_coils = (channels & (1U << 4U)) != 0;
  std::size_t at = datagram_header_bytes;
  for (std::size_t k = 0; k < count; ++k) {
    const double time_s = 1e-9 * (static_cast<double>(time_ns) + static_cast<double>(k) * period_ns);
    estimation::TimedSample& sample = out.samples.emplace_back(nothing_measured(time_s));
    for (const DatagramChannel* const channel : there.all()) {
      const float value = std::bit_cast<float>(little_endian<std::uint32_t>(bytes, at));
      member(sample, *channel) = std::isfinite(value) ? double{value} : estimation::not_measured;
      at += 4;
    }
    // See estimation::of_both_coils: measured, but not now.
    if (both_coils && std::isnan(sample.current_a_A)) sample.current_a_A = std::numeric_limits<double>::infinity();
  }
  return out;
}

std::vector<std::uint8_t> write_datagram(const DatagramHeader& header,
                                         std::span<const estimation::TimedSample> samples) {
  std::vector<std::uint8_t> out(datagram_mark.begin(), datagram_mark.end());
  out.push_back(version);
  out.push_back(0);
  put_little_endian(out, header.channels);
  put_little_endian(out, header.session);
  put_little_endian(out, static_cast<std::uint16_t>(samples.size()));
  put_little_endian(out, std::uint16_t{0});
  put_little_endian(out, header.sequence);
  put_little_endian(out, static_cast<std::uint64_t>(header.time_ns));
  put_little_endian(out, header.period_ns);
  out.insert(out.end(), header.valve.begin(), header.valve.end());
  out.resize(datagram_header_bytes, 0);
  const ChannelsThere there(header.channels);
  out.reserve(datagram_header_bytes + 4 * there.all().size() * samples.size() + datagram_checksum_bytes);
  for (estimation::TimedSample sample : samples) {
    for (const DatagramChannel* const channel : there.all())
      put_little_endian(out, std::bit_cast<std::uint32_t>(static_cast<float>(member(sample, *channel))));
  }
  put_little_endian(out, numerics::crc32(out));
  return out;
}

}  // namespace spoolflow::live

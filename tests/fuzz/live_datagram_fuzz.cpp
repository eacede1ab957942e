/// Datagrams of `spoolflow live`: each piece of the input (its length in the first two bytes) as it is, and once more
/// with mark, version, length and checksum as they must be, so that what lies behind these checks is reached.
#include <algorithm>

#include "addons/live/sources/datagram.hpp"
#include "addons/live/sources/udp_receiver.hpp"
#include "spoolflow/numerics/crc32.hpp"
#include "tests/fuzz/live_valve.hpp"

namespace {

using namespace spoolflow;

void put(std::vector<std::uint8_t>& bytes, std::size_t at, std::uint32_t value, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) bytes[at + k] = static_cast<std::uint8_t>(value >> 8 * k);
}

std::vector<std::uint8_t> made_whole(std::vector<std::uint8_t> bytes) {
  bytes.resize(std::max(bytes.size(), live::datagram_header_bytes), 0);
  const std::string_view mark("SFLW\1\0", 6);
  std::copy(mark.begin(), mark.end(), bytes.begin());
  const unsigned channels = bytes[6] | bytes[7] << 8U;
  std::size_t width = 0;
  for (unsigned rest = channels; rest != 0; rest &= rest - 1) ++width;
  const std::size_t numbers = (bytes.size() - live::datagram_header_bytes) / 4;
  const std::size_t samples = width == 0 ? 0 : numbers / width;
  put(bytes, 12, static_cast<std::uint32_t>(samples), 2);
  bytes.resize(live::datagram_header_bytes + 4 * width * (samples & 0xFFFFU));
  const std::uint32_t checksum = numerics::crc32(bytes);
  bytes.resize(bytes.size() + live::datagram_checksum_bytes);
  put(bytes, bytes.size() - live::datagram_checksum_bytes, checksum, 4);
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  live::Intake intake([] {});
  live::DatagramOrder order;
  const auto take = [&](const std::vector<std::uint8_t>& bytes) {
    auto read = live::read_datagram(bytes);
    auto* const datagram = std::get_if<live::Datagram>(&read);
    if (datagram == nullptr) return;
    fuzz::require(!datagram->samples.empty() && datagram->valve.size() <= live::longest_valve_id);
    live::SampleBlock block = order.next(std::move(*datagram), intake);
    if (!block.samples.empty()) intake.push(std::move(block));
  };
  std::span<const std::uint8_t> rest(data, size);
  while (rest.size() > 2) {
    const std::size_t length = std::min<std::size_t>(rest[0] | rest[1] << 8U, rest.size() - 2);
    const std::vector<std::uint8_t> piece(rest.begin() + 2, rest.begin() + 2 + static_cast<std::ptrdiff_t>(length));
    rest = rest.subspan(2 + length);
    take(piece);
    take(made_whole(piece));
  }
  fuzz::work_on_all(intake);
  return 0;
}

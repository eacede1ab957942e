/// CAN frames as datagrams of the bus: bytes as they come, and frames that the input's numbers make, written and read
/// again.
#include <algorithm>

#include "addons/live/protocols/can_text.hpp"
#include "tests/fuzz/input_file.hpp"

namespace {

using namespace spoolflow;

/// What the receiver may rely on.
void require_a_frame(const sensor::CanFrame& frame) {
  fuzz::require(frame.id < 1U << 29U && frame.size <= frame.data.size());
}

void write_and_read(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t head = 6;
  if (size < head) return;
  sensor::CanFrame frame;
  frame.extended = (data[4] & 1U) != 0;
  for (unsigned k = 0; k < 4; ++k) frame.id |= std::uint32_t{data[k]} << 8 * k;
  frame.id &= frame.extended ? 0x1FFFFFFFU : 0x7FFU;
  frame.size = static_cast<std::uint8_t>(std::min<std::size_t>({data[5], frame.data.size(), size - head}));
  std::copy_n(data + head, frame.size, frame.data.begin());
  const auto read = fieldbus::read_can_datagram(fieldbus::can_datagram(frame, 1.5));
  fuzz::require(read && read->id == frame.id && read->extended == frame.extended && read->size == frame.size);
  fuzz::require(std::equal(frame.data.begin(), frame.data.begin() + frame.size, read->data.begin()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto frame = fieldbus::read_can_datagram({reinterpret_cast<const char*>(data), size});
  if (frame) require_a_frame(*frame);
  write_and_read(data, size);
  return 0;
}

/// Blocks of a fleet: the input as it is, and once more with its rest as the body, compressed, and with mark, version,
/// lengths and checksum as they must be, so that what lies behind these checks is reached.
#include <algorithm>
#include <zstd.h>

#include "addons/live/blocks/block.hpp"
#include "spoolflow/numerics/crc32.hpp"
#include "tests/fuzz/input_file.hpp"

namespace {

using namespace spoolflow;

constexpr std::size_t header_bytes = 104;

void put(std::vector<std::uint8_t>& bytes, std::size_t at, std::uint64_t value, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) bytes[at + k] = static_cast<std::uint8_t>(value >> 8 * k);
}

std::vector<std::uint8_t> made_whole(std::span<const std::uint8_t> data) {
  std::vector<std::uint8_t> bytes(data.begin(),
                                  data.begin() + static_cast<std::ptrdiff_t>(std::min(data.size(), header_bytes)));
  bytes.resize(header_bytes);
  const std::string_view mark("SFBL\1\3", 6);
  std::copy(mark.begin(), mark.end(), bytes.begin());
  const auto body = data.subspan(std::min(data.size(), header_bytes));
  put(bytes, 38, 0, 2);          // a clock that there is
  put(bytes, 56, bytes[56], 4);  // few samples, as bodies are short
  put(bytes, 60, body.size(), 4);
  put(bytes, 64, 0, 8);
  bytes.insert(bytes.end(), {'a', '/', 'v'});
  const std::size_t before = bytes.size();
  if (!body.empty()) {
    bytes.resize(before + ZSTD_compressBound(body.size()));
    bytes.resize(before + ZSTD_compress(bytes.data() + before, bytes.size() - before, body.data(), body.size(), 1));
  }
  const std::uint32_t checksum = numerics::crc32(bytes);
  bytes.resize(bytes.size() + 4);
  put(bytes, bytes.size() - 4, checksum, 4);
  return bytes;
}

/// What is taken comes back the same.
void take(std::span<const std::uint8_t> bytes) {
  const auto read = fleet::read_block(bytes);
  const auto* const block = std::get_if<fleet::Block>(&read);
  if (block == nullptr) return;
  fuzz::require(block->samples.size() <= fleet::most_samples && block->first <= block->number);
  const std::vector<std::uint8_t> written = fleet::write_block(*block);
  const auto again = fleet::read_block(written);
  fuzz::require(std::holds_alternative<fleet::Block>(again));
  fuzz::require(fleet::write_block(std::get<fleet::Block>(again)) == written);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  take({data, size});
  take(made_whole({data, size}));
  return 0;
}

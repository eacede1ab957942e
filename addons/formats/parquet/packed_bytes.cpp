#include "addons/formats/parquet/packed_bytes.hpp"

#include <stdexcept>
#include <zstd.h>

#include <fmt/format.h>

namespace spoolflow::recording {

std::vector<std::uint8_t> packed(std::span<const std::uint8_t> bytes) {
  constexpr int level = 3;
  std::vector<std::uint8_t> out(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), level);
  if (ZSTD_isError(size) != 0) throw std::runtime_error(fmt::format("zstd: {}", ZSTD_getErrorName(size)));
  out.resize(size);
  return out;
}

}  // namespace spoolflow::recording

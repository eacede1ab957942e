#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace spoolflow::recording {

/// One zstd frame, its size in its head, at the library's usual level. Throws std::runtime_error where it refuses.
[[nodiscard]] std::vector<std::uint8_t> packed(std::span<const std::uint8_t> bytes);

}  // namespace spoolflow::recording

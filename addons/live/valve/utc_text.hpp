#pragma once
#include <cstdint>
#include <string>

namespace spoolflow::live {

/// 2026-11-22T10:30:00.250Z, from milliseconds since 1970.
[[nodiscard]] std::string utc(std::int64_t wall_ms);

}  // namespace spoolflow::live

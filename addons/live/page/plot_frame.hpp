#pragma once
/// A binary WebSocket message of the page's plot. All numbers are little endian.
///
///     byte  bytes
///        0      4  version, 1
///        4      4  points n
///        8      8  number of the first point since the program started; the last point of the message may still grow,
///                  and comes again under its number in the next
///       16      8  when the newest sample came [ns], by the machine's monotonic clock; 0: none yet
///       24      8  now, by the same clock
///       32     40n n points: time [s] as 64-bit number; then as 32-bit numbers smallest and largest flow, lowest and
///                  highest end of its band [L/min], position [mm], current [A]; status bits; 0
#include <cstdint>
#include <vector>

#include "addons/live/valve/valve_at_work.hpp"

namespace spoolflow::live {

inline constexpr std::size_t plot_frame_header_bytes = 32;
inline constexpr std::size_t plot_frame_point_bytes = 40;

[[nodiscard]] std::vector<std::uint8_t> plot_frame(const ValveAtWork::TracePart& part, std::int64_t now_ns);

}  // namespace spoolflow::live

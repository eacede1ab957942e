#pragma once
/// The sandbox of a process that reads an untrusted file.
#include <array>
#include <cstdint>

namespace spoolflow::recording {

/// Limits of a reading process.
struct ReadingLimits {
  std::uint64_t memory_bytes;  ///< address space beyond what the process has already
  std::uint64_t computing_s;   ///< processor time
};

/// Limits of a file of that size [bytes]: 512 MiB and 250 times the file (see DeclaredSize); 20 s and 2 s for each MiB
/// of it.
[[nodiscard]] ReadingLimits reading_limits(std::uint64_t file_bytes);

/// Closes every descriptor but these two (-1: none); 0 to 2 become /dev/null, but for the standard error of a build
/// with sanitizers, who report there.
void keep_only(std::array<int, 2> descriptors);

/// Limits memory and time; no larger file, no further process, no core dump, no new privileges. The limit of memory is
/// left out under AddressSanitizer, which reserves terabytes.
void give_up_rights(const ReadingLimits& limits);

/// From here on the process opens nothing any more: no descriptor beyond those it has, and of the system's calls only
/// those that reading, computing and answering need; every other one fails. Where the kernel has no filter of calls,
/// the limits alone hold. Does nothing in a build with sanitizers.
void give_up_opening();

}  // namespace spoolflow::recording

#pragma once
/// Where the samples of a TDMS file stand.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/recording/bytes/stored_number.hpp"

namespace spoolflow::recording {

/// One channel's samples within a chunk.
struct TdmsPart {
  std::size_t channel;                 ///< index among the file's channels
  std::optional<StoredNumber> number;  ///< nothing where they are times (16 bytes each) or cannot be read
  bool is_time = false;
  int bit = -1;  ///< of the number, where the sample is one of its bits
  ByteOrder order = ByteOrder::lowest_first;
  std::uint64_t count = 0;   ///< in a chunk
  std::uint64_t at = 0;      ///< byte of the first one within the chunk
  std::uint64_t stride = 0;  ///< bytes from one to the next
  std::string unread{};      ///< why they cannot be read: "text"; empty where they can

  bool operator==(const TdmsPart&) const = default;
};

struct TdmsChunk {
  std::vector<TdmsPart> parts;  ///< one a channel, in order of the channels
  std::uint64_t bytes = 0;

  /// Null where the channel has no samples in it.
  [[nodiscard]] const TdmsPart* part_of(std::size_t channel) const;
};

/// Chunks of one layout, one behind the other.
struct TdmsRun {
  std::shared_ptr<const TdmsChunk> chunk;
  std::uint64_t at;           ///< byte of the file
  std::uint64_t chunks;       ///< at least one
  std::uint64_t segment = 0;  ///< byte at which it begins
};

}  // namespace spoolflow::recording

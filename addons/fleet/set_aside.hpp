#pragma once
/// Blocks of a partition of which nothing is made, so that others go on: noted until a commit keeps them, then named.
#include <string>
#include <string_view>
#include <vector>

#include "addons/fleet/store/rows.hpp"
#include "addons/fleet/transport/nats.hpp"
#include "addons/live/blocks/block.hpp"

namespace spoolflow::fleet {

class SetAside {
 public:
  /// `reason` continues "the block is". `header`: null where the bytes have none.
  void add(const Message& message, const Block* header, std::string_view reason);
  /// A block that was read and is refused by the store.
  void add(const Block& block, const std::string& subject, std::string_view reason);

  [[nodiscard]] const SetAsideBlocks& waiting() const { return waiting_; }
  /// Behind their commit. Returns a line of each that came for the first time (PartitionStore::commit), a few at most.
  [[nodiscard]] std::vector<std::string> committed(std::int64_t partition, const std::vector<std::size_t>& first_seen);

 private:
  SetAsideBlocks waiting_;
};

}  // namespace spoolflow::fleet

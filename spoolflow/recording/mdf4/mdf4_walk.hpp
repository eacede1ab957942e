#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "spoolflow/recording/mdf4/mdf4_contents.hpp"

namespace spoolflow::recording {

/// The records of one group from the first to the last, a stretch after the other.
class Mdf4Walk {
 public:
  /// `group` must outlive it.
  explicit Mdf4Walk(const Mdf4Group& group) : group_(&group) {}

  /// Shows each of `count` records from `first` on, without its number, with its index. Forward it goes on from where
  /// it is; back it begins anew. Throws RecordingError where the records end too soon.
  void show(std::uint64_t first, std::size_t count,
            const std::function<void(const std::uint8_t*, std::uint64_t)>& record);

 private:
  /// The bytes of the stream from `at` on, within the buffer.
  const std::uint8_t* bytes(std::uint64_t at, std::uint64_t count);
  /// Of several kinds: where the next record of this one begins, behind its number.
  std::uint64_t next_own();

  const Mdf4Group* group_;
  std::uint64_t at_ = 0;    ///< byte of the stream, behind record next_ - 1
  std::uint64_t next_ = 0;  ///< index of the record that comes next
  std::vector<std::uint8_t> buffer_{};
  std::uint64_t begin_ = 0;  ///< byte of the stream with which the buffer begins
};

}  // namespace spoolflow::recording

#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "spoolflow/recording/mdf4/mdf4_contents.hpp"

namespace spoolflow::recording {

/// A stream's bytes, as they are asked for.
class Mdf4Bytes {
 public:
  /// `of`: for messages.
  explicit Mdf4Bytes(Mdf4Stream& stream, std::string of) : stream_(&stream), of_(std::move(of)) {}
  /// Those from `at` on, until the next call. Throws RecordingError where there are fewer.
  const std::uint8_t* from(std::uint64_t at, std::uint64_t count);

 private:
  Mdf4Stream* stream_;
  std::string of_;
  std::vector<std::uint8_t> buffer_{};
  std::uint64_t begin_ = 0;  ///< byte of the stream with which the buffer begins
};

/// The records of one group from the first to the last, a stretch after the other.
class Mdf4Walk {
 public:
  /// `group` must outlive it.
  explicit Mdf4Walk(const Mdf4Group& group);

  /// Shows each of `count` records from `first` on, without its number but with what of it is kept apart, with its
  /// index. Forward it goes on from where it is; back it starts again. Throws RecordingError where the records end too
  /// soon.
  void show(std::uint64_t first, std::size_t count,
            const std::function<void(const std::uint8_t*, std::uint64_t)>& record);

 private:
  /// Of several kinds: where the next record of this one begins, behind its number.
  std::uint64_t next_own();

  const Mdf4Group* group_;
  std::uint64_t at_ = 0;    ///< byte of the stream, behind record next_ - 1
  std::uint64_t next_ = 0;  ///< index of the record that comes next
  Mdf4Bytes bytes_, apart_;
  std::vector<std::uint8_t> joined_{};  ///< a record whose parts stand in two streams
};

}  // namespace spoolflow::recording

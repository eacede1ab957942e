#pragma once
#include <cmath>
#include <cstdint>
#include <string>

#include "spoolflow/recording/reader.hpp"

namespace spoolflow::recording {

/// Watches that time goes on: counts repeated stamps, refuses backward ones.
class TimeStamps {
 public:
  explicit TimeStamps(std::string file) : file_(std::move(file)) {}

  /// Looks at one row of the block; `line` is where it stands in the file. A row without a time stamp is refused as
  /// well.
  void check(const SampleBlock& block, std::size_t row, std::uint64_t line, ReadNotes& notes) {
    const auto& time = block.columns[static_cast<std::size_t>(Channel::time)];
    if (time.empty()) return;
    const double now_s = time[row];
    if (now_s > last_s_) {
      last_s_ = now_s;
      return;
    }
    if (now_s == last_s_) {
      ++notes.duplicate_times;
      return;
    }
    refuse(now_s, line);
  }

 private:
  [[noreturn]] void refuse(double now_s, std::uint64_t line) const;

  std::string file_;
  double last_s_ = -INFINITY;
};

}  // namespace spoolflow::recording

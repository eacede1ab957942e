#include "spoolflow/recording/files/vector_table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"

namespace spoolflow::recording {

void VectorTable::add(Vector vector) {
  constexpr std::size_t most = 65536;
  if (columns_.size() == most) {
    throw RecordingError(fmt::format("{}: holds more than {} columns of numbers; it is no recording", file_, most));
  }
  columns_.push_back(std::move(vector.column));
  lengths_.push_back(vector.length);
}

void VectorTable::select(const std::vector<std::size_t>& columns) {
  chosen_ = columns;
  if (columns.empty()) return;
  rows_ = lengths_[columns.front()];
  for (const std::size_t column : columns) {
    if (lengths_[column] == rows_) continue;
    throw RecordingError(
        fmt::format("{}: '{}' holds {} samples but '{}' holds {}; channels of one recording must be "
                    "equally long, so resample one of them or cut both to the same time",
                    file_, columns_[columns.front()].name, rows_, columns_[column].name, lengths_[column]));
  }
  chosen(columns);
}

std::size_t VectorTable::read(std::span<double* const> out, std::size_t rows) {
  auto count = static_cast<std::size_t>(std::min<std::uint64_t>(rows, rows_ - next_));
  first_of_block_ = next_;
  if (count == 0) return 0;
  count = at_once(next_, count);
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    copy(chosen_[k], next_, count, out[k]);
    if (!refuses_infinity_) continue;
    const double* const wrong = std::find_if(out[k], out[k] + count, [](double value) { return std::isinf(value); });
    if (wrong == out[k] + count) continue;
    throw RecordingError(
        fmt::format("{}, '{}': {} is not finite; remove it, or write NaN where a sample is missing, and save again",
                    place(static_cast<std::size_t>(wrong - out[k])), columns_[chosen_[k]].name, *wrong));
  }
  next_ += count;
  return count;
}

std::string VectorTable::place(std::size_t row) const {
  return fmt::format("{}, sample {}", file_, first_of_block_ + row + 1);
}

std::optional<double> VectorTable::progress() const {
  if (rows_ == 0) return std::nullopt;
  return static_cast<double>(next_) / static_cast<double>(rows_);
}

}  // namespace spoolflow::recording

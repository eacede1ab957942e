#include "spoolflow/recording/column_table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "spoolflow/recording/plausibility.hpp"
#include "spoolflow/recording/recording_error.hpp"
#include "spoolflow/recording/time_stamps.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t block_rows = 8192;

class ColumnTable final : public Reader {
 public:
  ColumnTable(std::vector<BoundColumn> columns, const std::string& file)
      : columns_(std::move(columns)), plausibility_(file), stamps_(file) {
    rows_ = columns_.empty() ? 0 : columns_.front().raw.size();
    for (const BoundColumn& column : columns_) {
      if (column.raw.size() != rows_) {
        throw RecordingError(
            fmt::format("{}: \"{}\" has {} samples, \"{}\" has {}; all channels of a recording are equally long", file,
                        columns_.front().name, rows_, column.name, column.raw.size()));
      }
      for (std::size_t k = 0; k < rows_; ++k) {
        if (!std::isfinite(column.raw[k])) {
          throw RecordingError(
              fmt::format("{}: sample {} of \"{}\" is {}; remove the sample from all channels, or interpolate it", file,
                          k + 1, column.name, column.raw[k]));
        }
      }
    }
    if (rows_ == 0) throw RecordingError(fmt::format("{}: holds no samples", file));
  }

  [[nodiscard]] bool has(Channel channel) const override {
    return std::any_of(columns_.begin(), columns_.end(),
                       [&](const BoundColumn& column) { return column.binding.channel == channel; });
  }
  bool next(SampleBlock& block) override {
    for (auto& column : block.columns) column.clear();
    block.rows = std::min(block_rows, rows_ - static_cast<std::size_t>(notes_.rows));
    const auto from = static_cast<std::size_t>(notes_.rows);
    for (const BoundColumn& column : columns_) {
      auto& out = block.columns[static_cast<std::size_t>(column.binding.channel)];
      for (std::size_t k = 0; k < block.rows; ++k)
        out.push_back(column.binding.scale * column.raw[from + k] + column.binding.offset);
    }
    for (std::size_t k = 0; k < block.rows; ++k) stamps_.check(block, k, from + k + 1, notes_);
    notes_.rows += block.rows;
    if (block.rows > 0) plausibility_.take(block);
    if (notes_.rows == rows_) plausibility_.check_sizes();
    return block.rows > 0;
  }
  [[nodiscard]] const ReadNotes& notes() const override { return notes_; }
  [[nodiscard]] std::optional<double> progress() const override {
    return static_cast<double>(notes_.rows) / static_cast<double>(rows_);
  }

 private:
  std::vector<BoundColumn> columns_;
  std::size_t rows_ = 0;
  Plausibility plausibility_;
  TimeStamps stamps_;
  ReadNotes notes_;
};

}  // namespace

std::unique_ptr<Reader> serve_columns(std::vector<BoundColumn> columns, const std::string& file) {
  return std::make_unique<ColumnTable>(std::move(columns), file);
}

}  // namespace spoolflow::recording

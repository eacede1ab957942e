#include "spoolflow/recording/reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "spoolflow/recording/channel_binding.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/memory_reader.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "spoolflow/recording/plausibility.hpp"
#include "spoolflow/recording/resampled_table.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::size_t block_rows = 4096;  // five channels of it stay in a core's second-level cache

std::size_t index(Channel channel) {
  return static_cast<std::size_t>(channel);
}

/// Raw numbers of any table, brought to SI and watched.
class ChannelReader final : public Reader {
 public:
  ChannelReader(std::unique_ptr<SampleTable> table, const ReadOptions& options, std::string file, OpenAgain open)
      : file_(std::move(file)),
        open_again_(std::move(open)),
        bound_(bind_channels(*table, options, file_)),
        plausibility_(file_, bound_, options.stroke_m),
        runs_on_(options.runs_on),
        infinite_is_missing_(options.infinite_is_missing) {
    if (infinite_is_missing_) table->let_infinite_pass();
    const std::string unread = unread_channels(*table, options, bound_, file_);
    OneClock clocked = on_one_clock(
        std::move(table), bound_, [this] { return open_again(); }, file_);
    table_ = std::move(clocked.table);
    std::string unapplied;
    for (const BoundColumn& column : bound_) {
      if (column.column >= table_->columns().size()) continue;  // the time of a waveform
      const std::string& said = table_->columns()[column.column].unapplied;
      if (!said.empty()) unapplied += (unapplied.empty() ? "" : "; ") + said;
    }
    for (const std::string& note : {table_->lost(), unread, unapplied, clocked.resampled}) {
      if (!note.empty()) notes_.resampled += (notes_.resampled.empty() ? "" : "; ") + note;
    }
    std::vector<std::size_t> chosen;
    for (const BoundColumn& column : bound_) {
      const auto same = std::ranges::find(chosen, column.column);
      source_of_.push_back(static_cast<std::size_t>(same - chosen.begin()));
      if (same == chosen.end()) chosen.push_back(column.column);
    }
    table_->select(chosen);
    raw_.resize(chosen.size());
  }

  [[nodiscard]] bool has(Channel channel) const override {
    return std::ranges::count(bound_, channel, &BoundColumn::channel) > 0;
  }

  bool next(SampleBlock& block) override {
    for (const Channel channel : all_channels) {
      if (!has(channel)) block.columns[index(channel)].clear();
    }
    // Each column of the file is read straight into the first channel that it serves.
    for (std::size_t k = 0; k < bound_.size(); ++k) {
      auto& values = block.columns[index(bound_[k].channel)];
      values.resize(block_rows);
      if (raw_[source_of_[k]] == nullptr) raw_[source_of_[k]] = values.data();
    }
    const std::size_t rows = table_->read(raw_, block_rows);
    for (std::size_t k = bound_.size(); k-- > 0;) {
      auto& values = block.columns[index(bound_[k].channel)];
      const double* const raw = raw_[source_of_[k]];
      if (raw != values.data()) std::copy(raw, raw + rows, values.data());
    }
    std::fill(raw_.begin(), raw_.end(), nullptr);
    for (const BoundColumn& column : bound_) {
      auto& values = block.columns[index(column.channel)];
      values.resize(rows);
      if (infinite_is_missing_) {
        for (std::size_t row = 0; row < rows; ++row) {
          if (!std::isinf(values[row])) continue;
          notes_.infinite[column.channel].take(values[row], notes_.rows + row + 1);
          values[row] = std::numeric_limits<double>::quiet_NaN();
        }
      }
      if (column.gain == 1.0 && column.offset == 0.0) continue;
      for (double& value : values) value = column.gain * value + column.offset;
    }
    block.rows = rows;
    if (rows == 0 && notes_.rows == 0) {
      throw RecordingError(fmt::format("{}: has a header but no samples; record it again or name another file", file_));
    }
    notes_.left_out = table_->left_out();
    if (rows == 0) {
      if (!runs_on_) plausibility_.finish();
      return false;
    }
    watch(block);
    notes_.rows += rows;
    return true;
  }

  [[nodiscard]] const ReadNotes& notes() const override { return notes_; }
  [[nodiscard]] std::optional<double> progress() const override { return table_->progress(); }

 private:
  void watch(const SampleBlock& block) {
    const std::vector<double>& time_s = block.columns[index(Channel::time)];
    for (std::size_t row = 0; row < block.rows; ++row) {
      if (time_s[row] > last_time_s_) {
        last_time_s_ = time_s[row];
      } else if (time_s[row] == last_time_s_) {
        ++notes_.duplicate_times;
      } else if (!runs_on_) {
        refuse_time(row, time_s[row]);
      } else if (std::isnan(time_s[row])) {
        ++notes_.missing_times;
      } else {
        ++notes_.backward_times;
        last_time_s_ = time_s[row];
      }
    }
    if (notes_.rows == 0 && !runs_on_ && !infinite_is_missing_) refuse_rounded_times(block.rows);
    const auto place = [this](std::size_t row) { return table_->place(row); };
    for (std::size_t k = 0; k < bound_.size(); ++k) {
      if (bound_[k].channel == Channel::time && runs_on_) continue;
      const std::vector<double>& values = block.columns[index(bound_[k].channel)];
      std::uint64_t missing = 0;
      for (const double value : values) missing += std::isnan(value) ? 1 : 0;
      notes_.missing[index(bound_[k].channel)] += missing;
      if (!runs_on_) plausibility_.take(k, values, place);
    }
  }

  /// Most samples of the first block at the time of the one before: by such times the valve stands and jumps.
  void refuse_rounded_times(std::size_t rows) const {
    constexpr std::size_t fewest = 100;
    const auto other = static_cast<double>(rows - notes_.duplicate_times);
    if (rows < fewest || 2 * notes_.duplicate_times < rows) return;
    const BoundColumn& column = bound_.front();
    throw RecordingError(fmt::format(
        "{}, column '{}': the times are rounded: {:.3g} samples have the same one on average; write them with more "
        "digits, or, where the recorder samples evenly, number the samples and give its time step as the time's scale "
        "in a channel map",
        file_, column.name, static_cast<double>(rows) / other));
  }

  [[noreturn]] void refuse_time(std::size_t row, double time_s) const {
    const std::string place = fmt::format("{}, column '{}'", table_->place(row), bound_.front().name);  // time
    if (std::isnan(time_s)) {
      throw RecordingError(fmt::format("{}: the time stamp is missing; every sample needs one", place));
    }
    throw RecordingError(
        fmt::format("{}: time runs backwards, from {} to {} s; cut the recording there, or sort it by "
                    "time",
                    place, last_time_s_, time_s));
  }

  [[nodiscard]] std::unique_ptr<SampleTable> open_again() const {
    std::unique_ptr<SampleTable> out = open_again_();
    if (infinite_is_missing_) out->let_infinite_pass();
    return out;
  }

  std::string file_;
  OpenAgain open_again_;
  std::unique_ptr<SampleTable> table_;
  std::vector<BoundColumn> bound_;
  std::vector<std::size_t> source_of_;  ///< for each bound column, which of the chosen columns
  std::vector<double*> raw_;
  Plausibility plausibility_;
  bool runs_on_;
  bool infinite_is_missing_;
  ReadNotes notes_;
  double last_time_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

FileContents contents_of(const std::filesystem::path& file) {
  return contents_of(std::make_unique<InputBytes>(file));
}

FileContents contents_of(std::unique_ptr<InputBytes> input) {
  const OpenTable open = open_sample_table(std::move(input));
  return contents_of(std::string(name(open.format)), *open.table);
}

std::unique_ptr<Reader> open_reader(const std::filesystem::path& file, const ReadOptions& options) {
  return open_reader(std::make_unique<InputBytes>(file), options);
}

std::unique_ptr<Reader> open_reader(std::unique_ptr<InputBytes> input, const ReadOptions& options) {
  const CsvTable::Text text = options.runs_on ? CsvTable::Text::left_out : CsvTable::Text::refused;
  const std::string name = input->name();
  return std::make_unique<ChannelReader>(open_sample_table(std::move(input), text).table, options, name,
                                         [name] { return open_sample_table(name).table; });
}

std::unique_ptr<Reader> open_reader(const OpenAgain& open, const ReadOptions& options, const std::string& name) {
  return std::make_unique<ChannelReader>(open(), options, name, open);
}

Recording read_recording(const std::filesystem::path& file, const ReadOptions& options) {
  Recording recording;
  recording.file = file;
  const std::unique_ptr<Reader> reader = open_reader(file, options);
  SampleBlock block;
  while (reader->next(block)) {
    for (const Channel channel : all_channels) {
      const std::vector<double>& values = block.columns[index(channel)];
      recording.column(channel).insert(recording.column(channel).end(), values.begin(), values.end());
    }
  }
  recording.resampled = reader->notes().resampled;
  return recording;
}

}  // namespace spoolflow::recording

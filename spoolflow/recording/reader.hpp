#pragma once
/// Opens any supported file as a stream of blocks of samples in SI units.
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <vector>

#include "spoolflow/recording/channels/channel.hpp"
#include "spoolflow/recording/files/file_contents.hpp"
#include "spoolflow/recording/files/input_bytes.hpp"
#include "spoolflow/recording/read_options.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::recording {

/// A run of consecutive samples; columns of channels that are absent or not asked for stay empty.
struct SampleBlock {
  std::array<std::vector<double>, channel_count> columns;
  std::size_t rows = 0;

  [[nodiscard]] const std::vector<double>& column(Channel channel) const {
    return columns[static_cast<std::size_t>(channel)];
  }
};

/// Infinite numbers among a column's samples.
struct InfiniteSamples {
  std::uint64_t count = 0;
  std::uint64_t first = 0;  ///< number of the first one's sample, from 1 on
  double value = 0;         ///< of the first one

  void take(double number, std::uint64_t sample) {
    if (count++ == 0) first = sample, value = number;
  }
};

/// What was met while reading and is reported rather than swallowed.
struct ReadNotes {
  std::uint64_t rows = 0;
  std::uint64_t duplicate_times = 0;                   ///< equal to the time stamp before
  std::array<std::uint64_t, channel_count> missing{};  ///< empty cells of each channel, but for time
  std::uint64_t missing_times = 0;                     ///< these and what follows only of a source that runs on
  std::uint64_t backward_times = 0;                    ///< before the time stamp before
  std::uint64_t left_out = 0;                          ///< lines that could not be read
  std::map<Channel, InfiniteSamples> infinite{};  ///< that were taken as missing (ReadOptions::infinite_is_missing)
  std::string resampled{};  ///< which columns had a time of their own, from which rate to which, and how;
                            ///< before it what of the file is missing (SampleTable::lost), and channels that
                            ///< were asked for where they can be had, but cannot be read

  [[nodiscard]] std::uint64_t missing_values() const {
    return std::accumulate(missing.begin(), missing.end(), std::uint64_t{0});
  }
};

/// Streams a recording; memory does not grow with its length (CSV; others are read in slabs).
class Reader {
 public:
  virtual ~Reader() = default;
  [[nodiscard]] virtual bool has(Channel channel) const = 0;
  /// Fills the next block (capacities are reused), of a pipe with the rows that have come; false at the end. Throws
  /// RecordingError: text in a number column, NaN or infinity written out, time running backwards, values implausible
  /// for their unit; with file, line and column.
  virtual bool next(SampleBlock& block) = 0;
  [[nodiscard]] virtual const ReadNotes& notes() const = 0;
  /// Share of the file read so far, 0 to 1; nothing where the length is unknown (a pipe).
  [[nodiscard]] virtual std::optional<double> progress() const = 0;
};

/// `file` "-" is standard input (CSV). The format is recognised by content (file_format.hpp). Columns with
/// times of their own are brought onto those of the current (resampled_table.hpp).
[[nodiscard]] std::unique_ptr<Reader> open_reader(const std::filesystem::path& file, const ReadOptions& options);

/// The same of an input that is open.
[[nodiscard]] std::unique_ptr<Reader> open_reader(std::unique_ptr<InputBytes> input, const ReadOptions& options);

/// What a file holds, of its path or its open bytes.
[[nodiscard]] FileContents contents_of(const std::filesystem::path& file);
[[nodiscard]] FileContents contents_of(std::unique_ptr<InputBytes> input);

/// The whole file at once.
[[nodiscard]] Recording read_recording(const std::filesystem::path& file, const ReadOptions& options);

}  // namespace spoolflow::recording

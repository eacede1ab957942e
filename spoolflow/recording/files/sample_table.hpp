#pragma once
/// What all file formats have in common: named columns of numbers, read from the first row to the last.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "spoolflow/recording/channels/even_times.hpp"
#include "spoolflow/recording/files/unread_part.hpp"

namespace spoolflow::recording {

/// A column of a file before anything is known about its meaning.
struct FileColumn {
  std::string name;  ///< as a channel map names it: CSV header, `struct.field`, `rig/time`
  /// The last part of the name, or what the file labels the column with: <channel>_<unit> is looked for in it.
  std::string leaf;
  std::string unit;  ///< written in the file beside the name (units row, attribute); empty where it is not
  EvenTimes wave{};  ///< as attributes of it state them; empty where none does
  std::optional<std::size_t> own_time{};  ///< the column of its times, where the file says which one that is
  /// What the file says of its numbers that is not applied to them, with its remedy; empty: nothing.
  std::string unapplied{};
};

/// Cells that hold text instead of a number.
struct TextCells {
  std::uint64_t count = 0;
  std::string first{};  ///< with its place
};

/// One open file. A new format implements this, and open_sample_table() recognises it by its content.
class SampleTable {
 public:
  SampleTable() = default;
  SampleTable(const SampleTable&) = delete;
  SampleTable& operator=(const SampleTable&) = delete;
  virtual ~SampleTable() = default;

  [[nodiscard]] virtual const std::vector<FileColumn>& columns() const = 0;
  /// Samples of a column where columns may differ in that; nothing where all rows have all columns.
  [[nodiscard]] virtual std::optional<std::uint64_t> samples_of(std::size_t) const { return std::nullopt; }
  /// What the file holds but is not read, for messages about missing channels and for whoever inspects it.
  [[nodiscard]] virtual std::vector<UnreadPart> unread() const { return {}; }
  /// What of the file is missing at its end, where it is read as far as it goes: "lacks ..."; empty: nothing.
  [[nodiscard]] virtual std::string lost() const { return {}; }
  /// Chooses the columns that read() fills, by index, each at most once. Once, before the first read().
  virtual void select(const std::vector<std::size_t>& columns) = 0;
  /// Fills `out[k]` (room for `rows` numbers) from the k-th chosen column; returns the number of rows, 0 at the end.
  /// Numbers are finite, or NaN where the sample is missing; infinite ones only after let_infinite_pass(). Throws
  /// RecordingError with file, place and value.
  virtual std::size_t read(std::span<double* const> out, std::size_t rows) = 0;
  /// Infinite numbers, which are refused else, are read as they stand from here on (to inspect).
  virtual void let_infinite_pass() {}
  /// Of each chosen column, where text is counted; none where it is refused.
  [[nodiscard]] virtual std::span<const TextCells> text_cells() const { return {}; }
  /// Rows that could not be read and were left out so far; nothing is where the table refuses them.
  [[nodiscard]] virtual std::uint64_t left_out() const { return 0; }
  /// Where row `row` of the last read() stands: "run.csv, line 17" or "run.mat, sample 16".
  [[nodiscard]] virtual std::string place(std::size_t row) const = 0;
  /// Share of the file read so far, 0 to 1; nothing where the length is unknown.
  [[nodiscard]] virtual std::optional<double> progress() const = 0;
};

}  // namespace spoolflow::recording

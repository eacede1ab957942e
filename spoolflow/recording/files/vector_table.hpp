#pragma once
/// A file of separate vectors (MATLAB, HDF5) as a table: the chosen ones must be equally long.
#include <cstdint>
#include <string>
#include <vector>

#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

class VectorTable : public SampleTable {
 public:
  /// A vector, or one column or row of a matrix.
  struct Vector {
    FileColumn column;
    std::uint64_t length;
  };

  [[nodiscard]] const std::vector<FileColumn>& columns() const final { return columns_; }
  void select(const std::vector<std::size_t>& columns) final;
  std::size_t read(std::span<double* const> out, std::size_t rows) final;
  [[nodiscard]] std::string place(std::size_t row) const final;
  void let_infinite_pass() final { infinite_passes_ = true; }
  [[nodiscard]] std::optional<double> progress() const final;
  [[nodiscard]] std::optional<std::uint64_t> samples_of(std::size_t column) const final { return lengths_[column]; }
  /// Samples of the column.
  [[nodiscard]] std::uint64_t length(std::size_t column) const { return lengths_[column]; }
  /// Reads the names of its columns, where the constructor only opens the file: a sandboxed process opens nothing any
  /// more then. Once, before all else. Throws RecordingError.
  virtual void look() {}
  /// Text in the place of a number is a missing sample from here on (to inspect), where else it is refused.
  virtual void take_text_as_missing() {}
  /// Copies `count` numbers from `first` on; the format's own slab may be larger. Throws RecordingError.
  virtual void copy(std::size_t column, std::uint64_t first, std::size_t count, double* out) = 0;

 protected:
  explicit VectorTable(std::string file) : file_(std::move(file)) {}
  void add(Vector vector);
  /// Set once, before the first copy().
  virtual void chosen(const std::vector<std::size_t>&) {}
  /// How many samples from `first` on copy() may be asked for at once.
  virtual std::size_t at_once(std::uint64_t, std::size_t wanted) { return wanted; }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  std::string file_;
  std::vector<FileColumn> columns_;
  std::vector<std::uint64_t> lengths_;
  std::vector<std::size_t> chosen_;
  std::uint64_t rows_ = 0;
  std::uint64_t next_ = 0;
  std::uint64_t first_of_block_ = 0;
  bool infinite_passes_ = false;
};

}  // namespace spoolflow::recording

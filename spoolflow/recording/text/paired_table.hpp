#pragma once
/// Text in which columns have times of their own, each at its own rate and of its own length (TwinCAT Scope, LabVIEW
/// with several X columns, CSV with a time beside each channel), as vectors: held in memory as a whole.
#include <memory>
#include <string>
#include <vector>

#include "spoolflow/recording/files/vector_table.hpp"
#include "spoolflow/recording/text/csv_table.hpp"

namespace spoolflow::recording {

class PairedTable final : public VectorTable {
 public:
  /// Reads `text` to its end. Times that are the same are one column. Throws RecordingError as reading does.
  PairedTable(std::unique_ptr<CsvTable> text, const std::string& file);

  void copy(std::size_t column, std::uint64_t first, std::size_t count, double* out) override;
  void take_text_as_missing() override { text_passes_ = true; }
  [[nodiscard]] std::span<const TextCells> text_cells() const override { return chosen_text_; }

 protected:
  void chosen(const std::vector<std::size_t>& columns) override;

 private:
  bool text_passes_ = false;
  std::vector<std::vector<double>> values_;
  std::vector<TextCells> text_;  ///< of all columns
  std::vector<TextCells> chosen_text_;
};

/// The table that a text is, by its content. Throws RecordingError as both do, and where a source that runs on
/// (Text::left_out) would have to be held in memory.
[[nodiscard]] std::unique_ptr<SampleTable> open_text_table(std::unique_ptr<InputBytes> input,
                                                           std::vector<char> beginning, CsvTable::Text text);

}  // namespace spoolflow::recording

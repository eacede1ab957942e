#include <algorithm>
#include <utility>

#include "spoolflow/recording/files/csv_writer.hpp"
#include "spoolflow/recording/written_tables/table_writers.hpp"

namespace spoolflow::recording {
namespace {

class CsvTableWriter final : public TableWriter {
 public:
  CsvTableWriter(TableHead head, TableOutput& output) : head_(std::move(head)), out_(output.in_sequence()), csv_(out_) {
    for (const NumberColumn& column : head_.numbers) {
      csv_.text(column.name);
      columns_.push_back({nullptr, static_cast<unsigned>(column.decimals)});
    }
    csv_.text(head_.flags);
    csv_.end_row();
  }

  void write(const TableRows& rows) override {
    for (std::size_t k = 0; k < columns_.size(); ++k) columns_[k].values = rows.numbers[k].data();
    for (std::size_t row = 0; row < rows.count(); ++row) {
      csv_.numbers(columns_, row);
      csv_.put(cell_of(rows.flags[row]));
      csv_.end_row();
    }
  }
  void hand_over() override {
    csv_.flush();
    out_.flush();
  }
  void finish() override { csv_.flush(); }

 private:
  /// Rows have the flags of the one before, mostly, and there are few sets of them.
  const std::string& cell_of(std::uint32_t flags) {
    if (flag_cells_.empty() || flag_cells_[last_].first != flags) {
      const auto known = std::ranges::find(flag_cells_, flags, &std::pair<std::uint32_t, std::string>::first);
      last_ = static_cast<std::size_t>(known - flag_cells_.begin());
      if (known == flag_cells_.end()) flag_cells_.emplace_back(flags, CsvWriter::cell(head_.flag_text(flags)));
    }
    return flag_cells_[last_].second;
  }

  TableHead head_;
  std::ostream& out_;
  CsvWriter csv_;
  std::vector<CsvWriter::FixedColumn> columns_;
  std::vector<std::pair<std::uint32_t, std::string>> flag_cells_;
  std::size_t last_ = 0;  ///< of flag_cells_
};

}  // namespace

std::unique_ptr<TableWriter> csv_table_writer(TableHead head, TableOutput& output) {
  return std::make_unique<CsvTableWriter>(std::move(head), output);
}

}  // namespace spoolflow::recording

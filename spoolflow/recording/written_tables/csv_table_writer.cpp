#include <utility>

#include "spoolflow/recording/files/csv_writer.hpp"
#include "spoolflow/recording/written_tables/table_writers.hpp"

namespace spoolflow::recording {
namespace {

class CsvTableWriter final : public TableWriter {
 public:
  CsvTableWriter(TableHead head, TableOutput& output) : head_(std::move(head)), out_(output.in_sequence()), csv_(out_) {
    for (const NumberColumn& column : head_.numbers) csv_.text(column.name);
    csv_.text(head_.flags);
    csv_.end_row();
  }

  void write(const TableRows& rows) override {
    for (std::size_t row = 0; row < rows.count(); ++row) {
      for (std::size_t k = 0; k < head_.numbers.size(); ++k)
        csv_.number(rows.numbers[k][row], head_.numbers[k].decimals);
      csv_.text(head_.flag_text(rows.flags[row]));
      csv_.end_row();
    }
  }
  void hand_over() override {
    csv_.flush();
    out_.flush();
  }
  void finish() override { csv_.flush(); }

 private:
  TableHead head_;
  std::ostream& out_;
  CsvWriter csv_;
};

}  // namespace

std::unique_ptr<TableWriter> csv_table_writer(TableHead head, TableOutput& output) {
  return std::make_unique<CsvTableWriter>(std::move(head), output);
}

}  // namespace spoolflow::recording

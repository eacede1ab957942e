#include "spoolflow/recording/written_tables/table_writers.hpp"

#include <stdexcept>
#include <utility>

namespace spoolflow::recording {

TableWriterMaker& parquet_writer_maker() {
  static TableWriterMaker of_the_program = nullptr;
  return of_the_program;
}

std::unique_ptr<TableWriter> table_writer(TableFormat format, TableHead head, TableOutput& output) {
  switch (format) {
    case TableFormat::parquet:
      if (parquet_writer_maker() != nullptr) return parquet_writer_maker()(std::move(head), output);
      throw std::invalid_argument(
          "Parquet is written by the add-on 'formats', which is not built in; in the sources `./run formats` builds "
          "it; "
          "or name a .csv, .h5 or .mat file");
    case TableFormat::hdf5:
      return hdf5_writer(std::move(head), output);
    case TableFormat::mat:
      return mat_writer(std::move(head), output);
    case TableFormat::csv:
      break;
  }
  return csv_table_writer(std::move(head), output);
}

}  // namespace spoolflow::recording

#include "spoolflow/recording/written_tables/table_writers.hpp"

#include <utility>

namespace spoolflow::recording {

std::unique_ptr<TableWriter> table_writer(TableFormat format, TableHead head, TableOutput& output) {
  switch (format) {
    case TableFormat::parquet:
      return parquet_writer(std::move(head), output);
    case TableFormat::mcap:
      return mcap_writer(std::move(head), output);
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

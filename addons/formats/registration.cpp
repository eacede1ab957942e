/// Makes the add-on's formats known to the core of every program that this file is linked into.
#include "addons/formats/parquet/parquet_writer.hpp"
#include "addons/formats/xlsx/xlsx_table.hpp"
#include "spoolflow/recording/open_table.hpp"
#include "spoolflow/recording/written_tables/table_writers.hpp"

namespace spoolflow::recording {
namespace {

[[maybe_unused]] const bool known = [] {
  workbook_opener() = open_xlsx_table;
  parquet_writer_maker() = parquet_writer;
  return true;
}();

}  // namespace
}  // namespace spoolflow::recording

#pragma once
#include <memory>

#include "spoolflow/recording/written_tables/table_output.hpp"
#include "spoolflow/recording/written_tables/table_writer.hpp"

namespace spoolflow::recording {

/// Apache Parquet 2: row groups of 131072 rows packed by zstd; numbers as DOUBLE, null for NaN, with the smallest and
/// largest of each group; flags by name through a dictionary. Units and notes are the file's key-value metadata
/// ("flow_L_min.unit"). Held in memory: one row group, and about a kilobyte for each one written.
[[nodiscard]] std::unique_ptr<TableWriter> parquet_writer(TableHead head, TableOutput& output);

}  // namespace spoolflow::recording

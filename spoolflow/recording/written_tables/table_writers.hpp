#pragma once
/// The writers, one a format.
#include <memory>

#include "spoolflow/recording/written_tables/table_format.hpp"
#include "spoolflow/recording/written_tables/table_output.hpp"
#include "spoolflow/recording/written_tables/table_writer.hpp"

namespace spoolflow::recording {

/// `output` must outlive the writer. Throws what the output throws, std::length_error where a format can hold no
/// more rows, std::runtime_error where a library refuses.
[[nodiscard]] std::unique_ptr<TableWriter> table_writer(TableFormat format, TableHead head, TableOutput& output);

/// Text, a line a row: numbers at their decimals, flags by name, an empty cell for NaN.
[[nodiscard]] std::unique_ptr<TableWriter> csv_table_writer(TableHead head, TableOutput& output);

/// Apache Parquet 2: row groups of 131072 rows packed by zstd; numbers as DOUBLE, null for NaN, with the smallest and
/// largest of each group; flags by name through a dictionary. Units and notes are the file's key-value metadata
/// ("flow_L_min.unit"). Held in memory: one row group, and about a kilobyte for each one written.
[[nodiscard]] std::unique_ptr<TableWriter> parquet_writer(TableHead head, TableOutput& output);

/// MCAP: one channel "/NAME" of JSON messages with a JSON schema, a message a row; chunks of about a megabyte packed by
/// zstd, with CRC and index. log_time and publish_time are the row's time in nanoseconds, counted from the first row
/// where that is below zero (the metadata record "NAME" then tells time_origin_s); a row without a time has that of the
/// row before. Numbers to their last digit, left out where they are not finite; flags by name. Held in memory: one
/// chunk, and 80 bytes for each one written.
[[nodiscard]] std::unique_ptr<TableWriter> mcap_writer(TableHead head, TableOutput& output);

/// HDF5: one dataset of doubles a column, with the attributes units and long_name; flags as unsigned 32-bit words with
/// the attributes flag_masks and flag_meanings of the CF conventions (section 3.5). In places.
[[nodiscard]] std::unique_ptr<TableWriter> hdf5_writer(TableHead head, TableOutput& output);

/// MATLAB, version 5 (`save -v6`), which MATLAB, Octave and SciPy read: one column vector of doubles a column; flags as
/// uint32; the struct NAME_units, text by column; the letters FLAGS_names, whose row k names bitget(FLAGS, k). Columns
/// gather in the scratch file, since this format has each in one piece. At most 2^28 - 16 rows (74 hours at 1 kHz):
/// std::length_error.
[[nodiscard]] std::unique_ptr<TableWriter> mat_writer(TableHead head, TableOutput& output);

}  // namespace spoolflow::recording

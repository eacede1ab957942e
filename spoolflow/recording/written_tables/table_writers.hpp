#pragma once
/// The writers, one a format.
#include <memory>

#include "spoolflow/recording/written_tables/table_format.hpp"
#include "spoolflow/recording/written_tables/table_output.hpp"
#include "spoolflow/recording/written_tables/table_writer.hpp"

namespace spoolflow::recording {

/// `output` must outlive the writer. Throws what the output throws, std::length_error where a format can hold no
/// more rows, std::runtime_error where a library refuses, std::invalid_argument where the format's add-on is missing.
[[nodiscard]] std::unique_ptr<TableWriter> table_writer(TableFormat format, TableHead head, TableOutput& output);

/// Text, a line a row: numbers at their decimals, flags by name, an empty cell for NaN.
[[nodiscard]] std::unique_ptr<TableWriter> csv_table_writer(TableHead head, TableOutput& output);

/// Makes a writer of a format that an add-on brings.
using TableWriterMaker = std::unique_ptr<TableWriter> (*)(TableHead head, TableOutput& output);
/// Of Parquet; null where the add-on `formats` is not built in.
[[nodiscard]] TableWriterMaker& parquet_writer_maker();

/// HDF5: one dataset of doubles a column, with the attributes units and long_name; flags as unsigned 32-bit words with
/// the attributes flag_masks and flag_meanings of the CF conventions (section 3.5). In places.
[[nodiscard]] std::unique_ptr<TableWriter> hdf5_writer(TableHead head, TableOutput& output);

/// MATLAB, version 5 (`save -v6`), which MATLAB, Octave and SciPy read: one column vector of doubles a column; flags as
/// uint32; the struct NAME_units, text by column; the letters FLAGS_names, whose row k names bitget(FLAGS, k). Columns
/// gather in the scratch file, since this format has each in one piece. At most 2^28 - 16 rows (74 hours at 1 kHz):
/// std::length_error.
[[nodiscard]] std::unique_ptr<TableWriter> mat_writer(TableHead head, TableOutput& output);

}  // namespace spoolflow::recording

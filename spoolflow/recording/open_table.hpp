#pragma once
/// Recognises a file's format by its content and opens it.
#include <filesystem>
#include <memory>
#include <vector>

#include "spoolflow/recording/file_format.hpp"
#include "spoolflow/recording/files/confined_table.hpp"
#include "spoolflow/recording/files/fork_server.hpp"
#include "spoolflow/recording/files/input_bytes.hpp"
#include "spoolflow/recording/files/sample_table.hpp"
#include "spoolflow/recording/text/csv_table.hpp"

namespace spoolflow::recording {

/// Of Excel workbooks; null where the add-on `formats` is not built in: then they are refused.
[[nodiscard]] OpenVectors& workbook_opener();

struct OpenTable {
  FileFormat format;
  std::unique_ptr<SampleTable> table;
};

/// "-" is standard input (CSV). Throws RecordingError where the file cannot be read or is of no known format.
[[nodiscard]] OpenTable open_sample_table(const std::filesystem::path& file,
                                          CsvTable::Text text = CsvTable::Text::refused);

/// The same of an input that is open.
[[nodiscard]] OpenTable open_sample_table(std::unique_ptr<InputBytes> input,
                                          CsvTable::Text text = CsvTable::Text::refused);

/// Whether the file is read by a process of its own (all but CSV). False of what cannot be read: opening it reports
/// why.
[[nodiscard]] bool takes_a_process(const std::filesystem::path& file);

/// For whoever opens these files while this process has several threads: to be held from before the second thread until
/// the last is gone. Null where none of the files is read by a process of its own (all but CSV).
[[nodiscard]] std::unique_ptr<ForkServer> fork_server_for(const std::vector<std::filesystem::path>& files);

}  // namespace spoolflow::recording

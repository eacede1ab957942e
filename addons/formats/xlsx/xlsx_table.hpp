#pragma once
#include <filesystem>
#include <memory>

#include "spoolflow/recording/files/vector_table.hpp"

namespace spoolflow::recording {

/// An Excel workbook (.xlsx, .xlsm): the first table of its first sheet that holds one (XlsxHeader), its columns by
/// their names. Empty cells and errors are missing samples; dates and times of day are seconds from the first one, to
/// 10 us. Rows that hold no number are left out. The sheet is read as a stream; its numbers are kept. Throws
/// RecordingError: no workbook, no table, damage; or where this build does not read workbooks.
[[nodiscard]] std::unique_ptr<VectorTable> open_xlsx_table(const std::filesystem::path& file);

}  // namespace spoolflow::recording

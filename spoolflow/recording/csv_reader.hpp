#pragma once
#include <memory>

#include "spoolflow/recording/column_binding.hpp"
#include "spoolflow/recording/reader.hpp"

namespace spoolflow::recording {

/// Streams a CSV file: comma, semicolon or tab; decimal point or, except with commas, decimal comma; a byte order mark;
/// quoted headers; an optional row of units below them; lines ended by LF or CRLF. Columns that nobody asked for are
/// skipped unparsed. An empty cell is a missing sample. "-" is standard input.
[[nodiscard]] std::unique_ptr<Reader> open_csv(const std::filesystem::path& file, const ReadOptions& options);
/// Its header, with the units row where there is one.
[[nodiscard]] std::vector<FileColumn> columns_of_csv(const std::filesystem::path& file);

}  // namespace spoolflow::recording

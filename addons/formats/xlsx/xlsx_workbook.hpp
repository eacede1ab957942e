#pragma once
/// What a workbook is made of: its sheets, and the parts that they share.
#include <string>
#include <vector>

#include "addons/formats/xlsx/xlsx_archive.hpp"

namespace spoolflow::recording {

struct XlsxSheet {
  std::string name;
  std::string part;  ///< of the archive
};

struct XlsxWorkbook {
  std::vector<XlsxSheet> sheets;      ///< of cells, not of a chart alone, that are not hidden; in the workbook's order
  std::vector<std::string> hidden{};  ///< names of the others
  std::string texts, styles;          ///< parts of the archive; empty: none
  bool from_1904 = false;             ///< days count from 1904-01-01 (old Excel for Macintosh), else from 1899-12-30
};

/// Follows the archive's relationships (ECMA-376 part 2), of files by Excel and of the strict form alike. Throws
/// RecordingError of archives that are no workbook of XML parts (xlsb, OpenDocument, Word, others), saying what they
/// are.
[[nodiscard]] XlsxWorkbook read_xlsx_workbook(XlsxArchive& archive);

}  // namespace spoolflow::recording

#pragma once
/// The rows of a sheet, one after the other.
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "addons/formats/xlsx/xlsx_styles.hpp"
#include "addons/formats/xlsx/xlsx_texts.hpp"
#include "addons/formats/xlsx/xlsx_workbook.hpp"

namespace spoolflow::recording {

inline constexpr std::uint32_t most_xlsx_columns = 16384;  ///< of a sheet: A to XFD

struct XlsxCell {
  enum class Kind : std::uint8_t {
    number,         ///< booleans, too: 1 and 0
    time,           ///< in days, as the workbook counts them
    text,           ///< also a number that is written as text, and a date of ISO 8601
    error,          ///< such as #N/A
    without_result  ///< a formula whose result the file does not hold
  };
  std::uint32_t column = 0;  ///< 0 is A
  Kind kind = Kind::number;
  bool in_percent = false;  ///< a number that is shown times 100, with the sign of percent
  double number = 0;
  std::string_view text{};  ///< until the next row
};

struct XlsxRow {
  std::uint64_t number = 0;  ///< 1 is the uppermost
  std::vector<XlsxCell> cells{};
};

/// "C17" of column 2 and row 17.
[[nodiscard]] std::string cell_name(std::uint32_t column, std::uint64_t row);

/// Shows each row that holds anything; ends where `show` returns false. Throws RecordingError where the sheet is
/// damaged.
void read_xlsx_rows(XlsxArchive& archive, const XlsxSheet& sheet, const XlsxTexts& texts, const XlsxStyles& styles,
                    const std::function<bool(const XlsxRow&)>& show);

}  // namespace spoolflow::recording

#pragma once
/// Which of a workbook's styles show numbers as dates, times or percentages.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "addons/formats/xlsx/xlsx_archive.hpp"

namespace spoolflow::recording {

enum class XlsxShown : std::uint8_t {
  number,
  time,    ///< date or time
  percent  ///< 0.221 as 22.1%
};

/// How a number format shows a number: "yyyy-mm-dd hh:mm:ss.000", "[h]:mm:ss" as a time, "0.0%" in percent, "0.00E+00",
/// "#,##0 \"days\"", "[Red]0" as it is (ECMA-376 part 1, 18.8.31).
[[nodiscard]] XlsxShown shown_by(std::string_view format);

class XlsxStyles {
 public:
  XlsxStyles() = default;
  /// `part`: empty where the workbook has no styles. Throws RecordingError where it is damaged.
  XlsxStyles(XlsxArchive& archive, const std::string& part);
  /// Of a cell with that style (its attribute `s`).
  [[nodiscard]] XlsxShown shown(std::uint64_t style) const {
    return style < shown_.size() ? shown_[style] : XlsxShown::number;
  }

 private:
  std::vector<XlsxShown> shown_{};
};

}  // namespace spoolflow::recording

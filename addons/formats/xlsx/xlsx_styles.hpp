#pragma once
/// Which of a workbook's styles show numbers as dates or times.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "addons/formats/xlsx/xlsx_archive.hpp"

namespace spoolflow::recording {

/// Whether a number format shows a date or a time: "yyyy-mm-dd hh:mm:ss.000", "[h]:mm:ss" do, "0.00E+00", "#,##0
/// \"days\"", "[Red]0" do not (ECMA-376 part 1, 18.8.31).
[[nodiscard]] bool shows_time(std::string_view format);

class XlsxStyles {
 public:
  XlsxStyles() = default;
  /// `part`: empty where the workbook has no styles. Throws RecordingError where it is damaged.
  XlsxStyles(XlsxArchive& archive, const std::string& part);
  /// Of a cell with that style (its attribute `s`).
  [[nodiscard]] bool is_time(std::uint64_t style) const { return style < is_time_.size() && is_time_[style]; }

 private:
  std::vector<bool> is_time_{};
};

}  // namespace spoolflow::recording

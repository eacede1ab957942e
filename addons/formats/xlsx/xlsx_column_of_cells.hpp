#pragma once
/// What the cells of one column of a sheet are worth, as rows bring them.
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "addons/formats/xlsx/xlsx_rows.hpp"
#include "spoolflow/recording/files/clock_time.hpp"

namespace spoolflow::recording {

/// The numbers of one column as rows bring them.
class XlsxColumnOfCells {
 public:
  static constexpr double missing = std::numeric_limits<double>::quiet_NaN();

  XlsxColumnOfCells(std::string sheet, bool from_1904) : sheet_(std::move(sheet)), from_1904_(from_1904) {}

  /// The value of a cell, NaN where it has none.
  double value(const XlsxCell& cell, std::uint64_t row);

  /// Whether there is anything in it but text.
  [[nodiscard]] bool is_used() const { return is_used_ || !has_text_; }
  [[nodiscard]] bool is_clock() const { return origin_.has_value(); }
  /// Whether its numbers are shown in percent; the values are shares.
  [[nodiscard]] bool is_in_percent() const { return in_percent_.value_or(false); }
  /// Of the first cell that is not as it should be; empty where all are.
  [[nodiscard]] const std::string& refusal() const {
    return refusal_.empty() && !comma_is_decimal_ ? doubtful_ : refusal_;
  }

 private:
  /// A number that is written as text, with a decimal point or a decimal comma: one kind in a column. 1,234 alone may
  /// be 1234 to its author, until another cell of the column decides.
  double text_number(const XlsxCell& cell, std::uint64_t row, double value);
  /// 1,234 and -12,345, but not 0,123 or 1,25.
  static bool may_group_thousands(std::string_view text);

  double number(const XlsxCell& cell, std::uint64_t row, double value);
  double since_first(const XlsxCell& cell, std::uint64_t row, const ClockTime& clock);
  [[nodiscard]] ClockTime clock_of(double days) const;
  double refuse(const XlsxCell& cell, std::uint64_t row, std::string_view why);

  std::string sheet_;  ///< "run.xlsx, 'Sheet1'!"
  bool from_1904_;
  std::optional<ClockTime> origin_{};
  std::optional<bool> in_percent_{};
  bool is_used_ = false, has_numbers_ = false, has_text_ = false;
  bool has_comma_ = false, has_point_ = false;  ///< numbers that are written as text
  bool comma_is_decimal_ = false;               ///< beyond doubt
  std::string doubtful_{};                      ///< refused unless that
  std::string refusal_{};
};

}  // namespace spoolflow::recording

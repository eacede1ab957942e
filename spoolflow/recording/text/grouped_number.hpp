#pragma once
/// Numbers in whose digits marks stand: 1.234,56 and 1'234 and 1,088.
#include <cstdint>
#include <optional>
#include <string_view>

namespace spoolflow::recording {

/// How a cell writes its number, without quotes, spaces and its sign.
enum class Writing : std::uint8_t { other, whole, grouped };
/// `whole`: 1 to 3 digits, which grouping would leave as they are. `grouped`: groups of three digits behind `mark`.
[[nodiscard]] Writing writing_of(std::string_view text, char mark);

/// A number whose thousands are grouped, such as 1.234,56.
struct GroupedNumber {
  double value;
  char point;  ///< its decimal sign; '\0': it has none

  [[nodiscard]] bool may_be_of(char decimal_sign) const { return point == decimal_sign || point == '\0'; }
};
/// Of point, comma, apostrophe or hard blank before groups of three digits, and of the decimal sign once behind them.
/// Nothing of other text, and of a point or comma alone: 1.234 may be 1234 or less than two.
[[nodiscard]] std::optional<GroupedNumber> without_groups(std::string_view cell);

}  // namespace spoolflow::recording

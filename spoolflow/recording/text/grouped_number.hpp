#pragma once
/// Numbers in whose digits marks stand: 1.234,56 and 1,088.
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
  char point;  ///< its decimal sign
};
/// Nothing where a cell does not hold both marks, one of them before groups of three digits and the other once behind
/// them: 1.234 alone is no such number.
[[nodiscard]] std::optional<GroupedNumber> without_groups(std::string_view cell);

}  // namespace spoolflow::recording

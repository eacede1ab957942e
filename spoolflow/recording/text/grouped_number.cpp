#include "spoolflow/recording/text/grouped_number.hpp"

#include <algorithm>
#include <string>

#include "spoolflow/recording/files/decimal_number.hpp"

namespace spoolflow::recording {
namespace {

constexpr char group_mark = '\'';

}  // namespace

Writing writing_of(std::string_view text, char mark) {
  constexpr std::string_view around = " \t\r\"-+";
  const std::size_t first = text.find_first_not_of(around);
  if (first == std::string_view::npos) return Writing::other;
  text = text.substr(first, text.find_last_not_of(around) - first + 1);
  const auto is_digits = [](std::string_view part) {
    return !part.empty() && std::ranges::all_of(part, [](char c) { return c >= '0' && c <= '9'; });
  };
  const std::string_view leading = text.substr(0, text.find(mark));
  if (!is_digits(leading) || leading.size() > 3 || leading.front() == '0') return Writing::other;
  if (leading.size() == text.size()) return Writing::whole;
  for (text.remove_prefix(leading.size()); !text.empty(); text.remove_prefix(4)) {
    if (text.size() < 4 || text.front() != mark || !is_digits(text.substr(1, 3))) return Writing::other;
  }
  return Writing::grouped;
}

std::optional<GroupedNumber> without_groups(std::string_view cell) {
  std::string digits(cell);
  bool only_groups = false;
  for (const std::string_view mark : {"'", "\xE2\x80\x99", "\xE2\x80\xAF", "\xC2\xA0", "\xA0"}) {
    for (std::size_t at = 0; (at = digits.find(mark, at)) != std::string::npos; ++at) {
      digits.replace(at, mark.size(), 1, group_mark);
      only_groups = true;
    }
  }
  const std::size_t last = digits.find_last_of(".,");
  const std::string_view whole = std::string_view(digits).substr(0, last);
  const char point = last == std::string::npos ? '\0' : digits[last];
  const char mark = only_groups ? group_mark : point == ',' ? '.' : ',';
  if ((point == '\0' && !only_groups) || writing_of(whole, mark) != Writing::grouped) return std::nullopt;
  std::erase(digits, mark);
  double value = 0;
  if (read_number(digits, point, value) != Digits::number) return std::nullopt;
  return GroupedNumber{value, point};
}

}  // namespace spoolflow::recording

#include "spoolflow/export/number_groups.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

namespace spoolflow::exports {

std::vector<NumberGroup> NumberGroups::in_order(std::size_t count) const {
  std::vector<NumberGroup> groups = groups_;
  std::ranges::sort(groups, [](const auto& a, const auto& b) { return a.first < b.first; });
  std::size_t next = 0;
  for (const NumberGroup& group : groups) {
    if (group.first != next)
      throw std::logic_error(fmt::format("number {} of the parameters is not described", std::min(next, group.first)));
    next += group.count;
  }
  if (next != count) throw std::logic_error(fmt::format("number {} of the parameters is not described", next));
  return groups;
}

std::string float_literal(double number) {
  std::string text = fmt::format("{}", single_precision(number));
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "F";
}

std::string literals(std::span<const double> numbers, std::span<const NumberGroup> groups) {
  std::string out;
  for (const NumberGroup& group : groups) {
    out += fmt::format("    // {}\n", group.meaning);
    for (std::size_t k = 0; k < group.count; ++k) {
      out += k % group.per_line == 0 ? "    " : " ";
      out += float_literal(numbers[group.first + k]) + ",";
      if ((k + 1) % group.per_line == 0 || k + 1 == group.count) out += '\n';
    }
  }
  return out;
}

}  // namespace spoolflow::exports

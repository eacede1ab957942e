#include "spoolflow/recording/text/cell_unit.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "spoolflow/recording/files/decimal_number.hpp"
#include "spoolflow/recording/files/header_name.hpp"
#include "spoolflow/recording/text/csv_cells.hpp"
#include "spoolflow/recording/text/grouped_number.hpp"
#include "spoolflow/recording/text/utf16.hpp"

namespace spoolflow::recording {
namespace {

using units::Dimension;

struct Prefix {
  std::string_view sign;
  double factor;
};
constexpr std::array<Prefix, 10> prefixes{{{"p", 1e-12},
                                           {"n", 1e-9},
                                           {"u", 1e-6},
                                           {"\xC2\xB5", 1e-6},
                                           {"\xCE\xBC", 1e-6},
                                           {"m", 1e-3},
                                           {"k", 1e3},
                                           {"K", 1e3},
                                           {"M", 1e6},
                                           {"G", 1e9}}};

std::optional<double> prefix_factor(std::string_view suffix) {
  const auto found = std::ranges::find(prefixes, suffix, &Prefix::sign);
  return found == prefixes.end() ? std::nullopt : std::optional(found->factor);
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Where the number at the front of a text ends; 0 where there is none.
std::size_t number_end(std::string_view text) {
  std::size_t at = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
  bool digits = false;
  for (; at < text.size() && (is_digit(text[at]) || text[at] == '.' || text[at] == ','); ++at)
    digits = digits || is_digit(text[at]);
  if (!digits) return 0;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t exponent = at + 1;
    if (exponent < text.size() && (text[exponent] == '-' || text[exponent] == '+')) ++exponent;
    if (exponent < text.size() && is_digit(text[exponent])) {
      while (exponent < text.size() && is_digit(text[exponent])) ++exponent;
      at = exponent;
    }
  }
  return at;
}

/// Whether a unit is one with a prefix before it: mA beside A.
bool has_prefix(const units::Unit& unit) {
  constexpr std::array<std::string_view, 12> prefixed{"ms", "us", "ns",   "mA",  "mV",  "mm",
                                                      "um", "kN", "mbar", "kPa", "MPa", "mL/min"};
  return std::ranges::count(prefixed, unit.name) > 0;
}

/// Behind a blank "m" is a metre, as "25 m" is.
bool is_metre(const CellParts& parts) {
  return parts.suffix == "m" && parts.number.data() + parts.number.size() != parts.suffix.data();
}

}  // namespace

std::optional<CellParts> split_cell(std::string_view cell) {
  constexpr std::size_t longest_suffix = 20;
  cell = without_blanks(cell);
  const std::size_t end = number_end(cell);
  const CellParts out{cell.substr(0, end), without_blanks(cell.substr(end))};
  if (end == 0 || out.suffix.empty() || out.suffix.size() > longest_suffix || !is_number(out.number)) return {};
  const std::string suffix = utf8_of(out.suffix);
  if (!prefix_factor(suffix) && (suffix == "-" || suffix == "\"" || !units::unit_named(suffix))) return {};
  return out;
}

bool measures(std::string_view cell) {
  return is_number(cell) || without_groups(cell) || split_cell(cell);
}

std::optional<units::Unit> unit_in_cell(std::string_view cell) {
  const auto parts = split_cell(cell);
  if (!parts || (prefix_factor(utf8_of(parts->suffix)) && !is_metre(*parts))) return std::nullopt;
  return units::unit_named(parts->suffix);
}

std::optional<units::Unit> unit_of(const FileColumn& column) {
  const auto header = channel_header(column);
  return units::unit_named(header && !header->unit.empty() ? header->unit : stated_unit(column));
}

Suffix read_measured(std::string_view cell, char point, const std::optional<units::Unit>& unit, double& value) {
  const auto parts = split_cell(cell);
  double number = 0;
  if (!parts || read_number(parts->number, point, number) != Digits::number) return Suffix::none;
  const std::string suffix = utf8_of(parts->suffix);
  const auto factor = prefix_factor(suffix);
  const bool of_length = unit && unit->dimension == Dimension::length;
  const bool kelvin = (suffix == "K" || suffix == "k") && unit && unit->dimension == Dimension::temperature;
  if (factor && !kelvin && !(is_metre(*parts) && of_length)) {
    if (!unit || (suffix == "m" && of_length)) return Suffix::ambiguous;
    if (has_prefix(*unit)) return Suffix::prefix_twice;
    value = number * *factor;
    return Suffix::understood;
  }
  const auto stated = units::unit_named(suffix);
  if (!unit || !stated || stated->dimension != unit->dimension) return Suffix::other_quantity;
  value = stated->name == unit->name ? number : unit->from_SI(stated->to_SI(number));
  return Suffix::understood;
}

std::string suffix_fault(Suffix fault, std::string_view cell, const std::optional<units::Unit>& unit) {
  const std::string column =
      unit ? fmt::format("the column is in {}", unit->name) : "the file states no unit for the column";
  constexpr std::string_view remedy =
      "name the column with its unit, such as current_A or I [A], or write the numbers without suffixes";
  switch (fault) {
    case Suffix::ambiguous:
      return unit ? fmt::format("'{}' may be in milli or in metres, where {}; write the numbers without suffixes", cell,
                                column)
                  : fmt::format("'{}' has a prefix, and {}; {}", cell, column, remedy);
    case Suffix::prefix_twice:
      return fmt::format("'{}' has a prefix, and {}, which has one as well; write the numbers without suffixes", cell,
                         column);
    default:
      return fmt::format("'{}' states a unit, but {}; {}", cell, column, remedy);
  }
}

}  // namespace spoolflow::recording

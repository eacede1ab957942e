#include "spoolflow/recording/files/header_name.hpp"

#include "spoolflow/recording/files/decimal_number.hpp"

namespace spoolflow::recording {
namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

/// `flow_1` and `current_s` are numbered or lettered foreign columns, not channels in the units "1" and "s".
bool may_be_meant(Channel channel, const units::Unit& unit) {
  if (unit.dimension == dimension(channel)) return true;
  return unit.name == "percent" ||
         (unit.dimension != units::Dimension::ratio && unit.dimension != units::Dimension::time);
}

}  // namespace

BracketedName split_brackets(std::string_view name) {
  name = trimmed(name);
  if (name.empty()) return {name, {}};
  const char close = name.back();
  const char open = close == ']' ? '[' : close == ')' ? '(' : '\0';
  const std::size_t at = open == '\0' ? std::string_view::npos : name.rfind(open);
  if (at == std::string_view::npos) return {name, {}};
  const std::string_view inside = name.substr(at + 1, name.size() - at - 2);
  if (inside.find_first_not_of("0123456789:, ") == std::string_view::npos && inside != "1") return {name, {}};
  return {trimmed(name.substr(0, at)), trimmed(inside)};
}

bool is_units_row(const std::vector<std::string_view>& cells) {
  bool known = false;
  for (const std::string_view cell : cells) {
    if (is_number(cell)) return false;
    const std::string_view bracketed = split_brackets(cell).unit;
    known = known || units::unit_named(bracketed.empty() ? cell : bracketed).has_value();
  }
  return known;
}

std::string stated_unit(const FileColumn& column) {
  if (!column.unit.empty())
    return std::string(split_brackets(column.unit).unit.empty() ? trimmed(column.unit)
                                                                : split_brackets(column.unit).unit);
  return std::string(split_brackets(column.leaf).unit);
}

std::optional<ChannelHeader> channel_header(const FileColumn& column) {
  const std::string_view stem = split_brackets(column.leaf).stem;
  if (const auto channel = channel_named(stem)) {
    std::string unit = stated_unit(column);
    if (unit.empty() && *channel == Channel::test) unit.assign(1, '1');
    return ChannelHeader{*channel, unit};
  }
  for (const Channel channel : all_channels()) {
    if (!stem.starts_with(name(channel))) continue;
    const std::string_view rest = stem.substr(name(channel).size());
    if (rest.size() < 2 || rest.front() != '_') continue;
    const auto unit = units::unit_named(rest.substr(1));
    if (unit && may_be_meant(channel, *unit)) return ChannelHeader{channel, std::string(unit->name)};
  }
  return std::nullopt;
}

}  // namespace spoolflow::recording

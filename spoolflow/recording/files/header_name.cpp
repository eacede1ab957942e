#include "spoolflow/recording/files/header_name.hpp"

#include <algorithm>
#include <array>
#include <cctype>

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

bool is_gap(char c) {
  return c == '_' || c == ' ' || c == '-' || c == '.';
}

char small(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// What stands behind the channel's name, however the name is written: "Oil_Temperature", "oil temperature" and
/// "OilTemperature" are all oil_temperature.
std::optional<std::string_view> behind_name(std::string_view written, Channel channel) {
  for (const char c : name(channel)) {
    if (c != '_') {
      if (written.empty() || small(written.front()) != c) return std::nullopt;
      written.remove_prefix(1);
    } else if (!written.empty() && is_gap(written.front())) {
      written.remove_prefix(1);
    }
  }
  return written;
}

/// A capital letter at the end that may be the unit: Current_A is a current in A, where Voltage_A is that of coil a.
bool ends_in_unit(std::string_view stem, Channel channel) {
  const std::string_view own = name(channel);
  const auto unit = own[own.size() - 2] == '_' ? units::unit_named(stem.substr(stem.size() - 1)) : std::nullopt;
  return unit && stem.back() != own.back() && unit->dimension == dimension(channel);
}

/// A channel's name in other letters or with other gaps. It counts with a unit of that channel only.
std::optional<ChannelHeader> similar_header(std::string_view stem, const std::string& stated) {
  const auto suits = [](Channel channel, const std::optional<units::Unit>& unit) {
    return unit && (unit->dimension == dimension(channel) || (channel == Channel::position && unit->name == "percent"));
  };
  for (const bool whole : {true, false}) {
    for (const Channel channel : all_channels) {
      const auto rest = channel == Channel::test ? std::nullopt : behind_name(stem, channel);
      if (!rest || rest->empty() != whole) continue;
      if (whole && suits(channel, units::unit_named(stated)) && !ends_in_unit(stem, channel))
        return ChannelHeader{channel, stated, false};
      const auto unit = rest->size() > 1 && rest->front() == '_' ? units::unit_named(rest->substr(1)) : std::nullopt;
      if (suits(channel, unit)) return ChannelHeader{channel, std::string(unit->name), false};
    }
  }
  return std::nullopt;
}

/// What stands between a pair of brackets, which begins and ends there.
struct Bracketed {
  std::size_t begin, end;
  std::string_view inside;
};

/// (:,2), [0], (k): right behind a name. With a blank between, [1] is the unit of a share.
bool is_index(std::string_view inside, bool attached) {
  if (inside.find_first_not_of("0123456789:, ") == std::string_view::npos) return attached || inside != "1";
  return inside.find(':') != std::string_view::npos || (attached && (inside == "k" || inside == "n"));
}

/// All that are no indices.
std::vector<Bracketed> brackets_of(std::string_view name) {
  std::vector<Bracketed> out;
  for (std::size_t at = 0; (at = name.find_first_of("[(", at)) != std::string_view::npos; ++at) {
    const std::size_t close = name.find_first_of(name[at] == '[' ? "[]" : "()", at + 1);
    if (close == std::string_view::npos || name[close] == name[at]) continue;  // an inner pair follows
    const std::string_view inside = trimmed(name.substr(at + 1, close - at - 1));
    const bool attached = at > 0 && name[at - 1] != ' ';
    if (!inside.empty() && !is_index(inside, attached)) out.push_back({at, close + 1, inside});
  }
  return out;
}

/// Less what joins a name and its unit: "I / ", "Position, ", "Current in".
std::string_view without_joints(std::string_view stem) {
  const auto ends = [&](std::string_view joint) { return stem.size() > joint.size() && stem.ends_with(joint); };
  while (ends(" ") || ends(",") || ends(";") || ends("/") || ends(":") || ends("-") || ends("_")) stem.remove_suffix(1);
  if (ends(" in")) stem.remove_suffix(3);
  return trimmed(stem);
}

/// Whether a word of a name can only be meant as a unit.
bool is_unit_word(std::string_view word) {
  constexpr std::array<std::string_view, 10> several_meanings{"in",   "second", "meter", "metre", "mil",
                                                              "thou", "-",      "lb",    "kp",    "min"};
  constexpr std::array<std::string_view, 5> letters{"s", "V", "N", "K", "m"};
  if (word.size() == 1) return std::ranges::count(letters, word) > 0;
  const bool number = word.find_first_not_of("0123456789.") == std::string_view::npos;
  return !number && std::ranges::count(several_meanings, word) == 0 && units::unit_named(word).has_value();
}

/// "I_coil mA", "Current in mA", "Temp degC, filtered", "deg C" as two words; "I/mA".
NameAndUnit unit_among_words(std::string_view name) {
  constexpr std::string_view gaps = " ,;";
  for (std::size_t end = name.size(); end > 0 && end != std::string_view::npos;) {
    const std::size_t gap = name.substr(0, end).find_last_of(gaps);
    if (gap == std::string_view::npos || gap == 0) break;
    const std::size_t before = name.substr(0, gap).find_last_of(gaps);
    const std::string_view word = name.substr(gap + 1, end - gap - 1);
    if (before != std::string_view::npos && before > 0) {
      const std::string_view two = name.substr(before + 1, end - before - 1);
      if (two.starts_with("in ") && units::unit_named(word)) return {without_joints(name.substr(0, gap)), word};
      if (two.starts_with("deg") && units::unit_named(two)) return {without_joints(name.substr(0, before)), two};
    }
    if (is_unit_word(word)) return {without_joints(name.substr(0, gap)), word};
    end = gap;
  }
  const std::size_t slash = name.find('/');
  if (slash == std::string_view::npos || slash == 0) return {name, {}};
  const std::string_view unit = trimmed(name.substr(slash + 1));
  constexpr std::size_t longest_symbol = 2;  // U/V, where bench/V is a channel in a group
  const bool is_unit = units::unit_named(unit) && (unit.size() > 1 || slash <= longest_symbol) && unit != "in";
  return is_unit ? NameAndUnit{without_joints(name.substr(0, slash)), unit} : NameAndUnit{name, {}};
}

}  // namespace

NameAndUnit split_unit(std::string_view name) {
  name = trimmed(name);
  const std::vector<Bracketed> brackets = brackets_of(name);
  const auto named_unit = [&](const Bracketed& each) { return units::unit_named(each.inside).has_value(); };
  const bool at_end = !brackets.empty() && brackets.back().end == name.size();
  const auto first = std::ranges::find_if(brackets, named_unit);
  if (at_end && (named_unit(brackets.back()) || first == brackets.end()))
    return {without_joints(name.substr(0, brackets.back().begin)), brackets.back().inside};
  if (first != brackets.end()) return {without_joints(name.substr(0, first->begin)), first->inside};
  return unit_among_words(name);
}

std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> out(1);
  char last = '_';
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) == 0) {
      if (!out.back().empty()) out.emplace_back();
    } else {
      const bool begins = std::isupper(byte) != 0 && std::islower(static_cast<unsigned char>(last)) != 0;
      if (begins) out.emplace_back();
      out.back() += c;
    }
    last = c;
  }
  for (std::string& word : out) {
    if (word == "T") continue;
    std::ranges::transform(word, word.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  }
  std::erase(out, "");
  return out;
}

bool is_units_row(const std::vector<std::string_view>& cells) {
  bool known = false;
  for (const std::string_view cell : cells) {
    const NameAndUnit split = split_unit(cell);
    const bool alone = units::unit_named(cell) || (split.stem.empty() && units::unit_named(split.unit));
    const bool named = !alone && !split.stem.empty() && units::unit_named(split.unit);
    if (is_number(cell) || named) return false;
    known = known || alone;
  }
  return known;
}

std::string stated_unit(const FileColumn& column) {
  if (column.unit.empty()) return std::string(split_unit(column.leaf).unit);
  const NameAndUnit beside = split_unit(column.unit);  // "[mA]", and "V (voltage)"
  const bool whole = beside.unit.empty() || units::unit_named(column.unit).has_value();
  const bool before = !whole && units::unit_named(beside.stem).has_value();
  return std::string(whole ? trimmed(column.unit) : before ? beside.stem : beside.unit);
}

std::optional<ChannelHeader> channel_header(const FileColumn& column) {
  const std::string_view stem = split_unit(column.leaf).stem;
  if (const auto channel = channel_named(stem)) {
    std::string unit = stated_unit(column);
    if (unit.empty() && *channel == Channel::test) unit.assign(1, '1');
    return ChannelHeader{*channel, unit};
  }
  for (const Channel channel : all_channels) {
    if (!stem.starts_with(name(channel))) continue;
    const std::string_view rest = stem.substr(name(channel).size());
    if (rest.size() < 2 || rest.front() != '_') continue;
    const auto unit = units::unit_named(rest.substr(1));
    if (unit && may_be_meant(channel, *unit)) return ChannelHeader{channel, std::string(unit->name)};
  }
  return similar_header(stem, stated_unit(column));
}

}  // namespace spoolflow::recording

#include "spoolflow/recording/channel_binding.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/recording/channels/allowed_names.hpp"
#include "spoolflow/recording/channels/channel_unit.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/column_clock.hpp"
#include "spoolflow/recording/files/file_contents.hpp"
#include "spoolflow/recording/files/header_name.hpp"
#include "spoolflow/recording/files/time_name.hpp"
#include "spoolflow/recording/proposal.hpp"

namespace spoolflow::recording {
namespace {

class Binder {
 public:
  Binder(const SampleTable& table, const ReadOptions& options, const std::string& file)
      : table_(table), columns_(table.columns()), unread_(table.unread()), options_(options), file_(file) {}

  std::optional<BoundColumn> bind(Channel channel) const {
    const auto source = options_.channels.sources.find(channel);
    std::optional<BoundColumn> found =
        source != options_.channels.sources.end() ? mapped(channel, source->second) : by_header(channel);
    const auto other = options_.stands_in.find(channel);
    if (found || other == options_.stands_in.end()) return found;
    found = bind(other->second);
    if (found) found->channel = channel;
    return found;
  }

  /// Of a file with several times, or with one of another length than the leading channel: the leading channel's.
  std::optional<BoundColumn> time(const std::vector<BoundColumn>& others) const {
    const BoundColumn* const leading = leading_channel(others);
    if (options_.channels.sources.contains(Channel::time) || leading == nullptr || !table_.samples_of(leading->column))
      return bind(Channel::time);
    std::vector<std::size_t> times, taken;
    for (std::size_t index = 0; index < columns_.size(); ++index) {
      const auto header = channel_header(columns_[index]);
      if (header && header->channel == Channel::time) times.push_back(index);
    }
    if (times.size() == 1 && table_.samples_of(times.front()) == table_.samples_of(leading->column))
      return bind(Channel::time);
    for (const BoundColumn& other : others) taken.push_back(other.column);
    const auto clock = clock_of(table_, leading->column, std::nullopt, taken, file_);
    if (!clock) return bind(Channel::time);
    if (clock->time) return as_time(*clock->time);
    return BoundColumn{columns_.size(),        Channel::time, 1, 0, "wf_increment of " + leading->name,
                       *units::unit_named("s")};
  }

  [[noreturn]] void missing(Channel channel) const {
    std::string hint;
    for (const FileColumn& column : columns_) {
      const std::string_view leaf = split_unit(column.leaf).stem;
      if (leaf.starts_with(name(channel)) && leaf.size() > name(channel).size() + 1 &&
          leaf[name(channel).size()] == '_' && !channel_header(column)) {
        const std::string_view unit = leaf.substr(name(channel).size() + 1);
        hint = fmt::format("; '{}' would be it, but '{}' is no known unit{}", column.name, unit,
                           did_you_mean(unit, unit_names(channel)));
      }
    }
    if (channel == Channel::current && (by_header(Channel::current_a) || by_header(Channel::current_b))) {
      hint =
          "; the file has those of a whole valve's coils, where position > 0 and flow > 0 are P to B: a model of both "
          "directions reads it, for a model of P to A alone map current to coil a, and position and flow with scale "
          "-1";
    }
    if (const std::string lost = table_.lost(); !lost.empty()) hint += "; the file " + lost;
    if (const std::string unread = unread_for(channel); !unread.empty()) hint += "; " + unread;
    if (hint.empty()) {
      const ChannelMap guessed = guesses();
      const auto other = guessed.sources.find(channel);
      if (other != guessed.sources.end()) hint = fmt::format("; '{}' may be it", other->second.column);
    }
    throw RecordingError(
        fmt::format("{}: channel {} is missing{}; the columns are {}. Name the column {}_<unit> (unit: {}) or say in a "
                    "channel map which column it is (`spoolflow inspect` proposes one)",
                    file_, name(channel), hint, columns_.empty() ? "none" : listed(column_names()), name(channel),
                    listed(unit_names(channel))));
  }

  /// Which columns may be which channels, by other names too.
  ChannelMap guesses() const { return propose_channels(contents_of("", table_)).map; }

  /// What would be that channel by its name, if it could be read; empty: nothing.
  std::string unread_as(Channel channel) const {
    for (const UnreadPart& part : unread_) {
      const auto header = channel_header({part.column, part.column.substr(part.column.find_last_of("./") + 1), "?"});
      if (header && header->channel == channel) return part.what;
    }
    return {};
  }

 private:
  /// What may be the reason that a channel is not found.
  std::string unread_for(Channel channel) const {
    const std::string own = unread_as(channel);
    return own.empty() && !unread_.empty() ? unread_.front().what : own;
  }

  /// Likewise of a column that a map names; a group of MDF may stand before it there.
  std::string unread_column(const std::string& wanted) const {
    const auto same = [&](const UnreadPart& part) {
      return !part.column.empty() && (wanted == part.column || wanted.ends_with("/" + part.column));
    };
    const auto found = std::ranges::find_if(unread_, same);
    return found == unread_.end() ? "" : "; " + found->what;
  }

  std::vector<std::string> column_names() const {
    std::vector<std::string> out;
    for (const FileColumn& column : columns_) out.push_back(column.name);
    return out;
  }

  std::string map_place() const { return options_.channels.place.empty() ? file_ : options_.channels.place; }

  /// Index of the only column of that name.
  std::size_t column_named(Channel channel, const std::string& wanted) const {
    const auto first = std::ranges::find(columns_, wanted, &FileColumn::name);
    const auto numbered = std::ranges::find(columns_, wanted + " #1", &FileColumn::name);
    if (first == columns_.end() && numbered != columns_.end()) {
      throw RecordingError(
          fmt::format("{}: channel {} is mapped to column '{}', of which {} has more than one; choose '{} #1', '{} #2' "
                      "or a later one in the channel map",
                      map_place(), name(channel), wanted, file_, wanted, wanted));
    }
    if (first == columns_.end()) {
      throw RecordingError(
          fmt::format("{}: channel {} is mapped to column '{}', which {} does not have{}{}; its columns "
                      "are {}",
                      map_place(), name(channel), wanted, file_, unread_column(wanted),
                      unread_column(wanted).empty() ? did_you_mean(wanted, column_names()) : "",
                      columns_.empty() ? "none" : listed(column_names())));
    }
    return static_cast<std::size_t>(first - columns_.begin());
  }

  std::optional<BoundColumn> mapped(Channel channel, const ChannelSource& source) const {
    const std::size_t index = column_named(channel, source.column);
    const FileColumn& column = columns_[index];
    const std::string place = fmt::format("{}, column '{}'", map_place(), column.name);
    const std::string stated = stated_unit(column);
    std::string written = source.unit;
    if (written.empty()) {
      const auto header = channel_header(column);
      written = !stated.empty() ? stated : header && header->channel == channel ? header->unit : "";
    } else if (source.scale == 1.0 && source.offset == 0.0 && !source.to) {
      refuse_other_unit(channel, column, written, stated);
    }
    if (source.to) written = *source.to;
    if (written.empty()) {
      throw RecordingError(
          fmt::format("{}: the unit of channel {} is given neither in the map nor in the file; add "
                      "unit = \"{}\" or the one that it has ({})",
                      place, name(channel), unit_names(channel).front(), listed(unit_names(channel))));
    }
    const units::Unit unit = channel_unit(channel, written, options_.stroke_m, place);
    return BoundColumn{index,       channel, unit.factor * source.scale, unit.factor * source.offset + unit.offset,
                       column.name, unit};
  }

  void refuse_other_unit(Channel channel, const FileColumn& column, const std::string& mapped,
                         const std::string& stated) const {
    const auto said = units::unit_named(stated);
    const auto given = units::unit_named(mapped);
    if (stated.empty() || !said || !given || said->name == given->name) return;
    throw RecordingError(
        fmt::format("{}: channel {} is mapped with unit {}, but {} states {} for column '{}'; correct "
                    "the map, or the file if it is wrong",
                    map_place(), name(channel), mapped, file_, stated, column.name));
  }

  /// The unit in a column's name and the one beside it.
  void refuse_two_units(const FileColumn& column, Channel channel, const std::string& in_name) const {
    const auto named = units::unit_named(in_name);
    const auto beside = units::unit_named(stated_unit(column));
    if (!named || !beside || named->name == beside->name || beside->dimension != named->dimension) return;
    throw RecordingError(
        fmt::format("{}, column '{}': the unit of channel {} is {} by its name and {} by what stands beside it; say in "
                    "a channel map which channel it is, with its unit",
                    file_, column.name, name(channel), named->name, beside->name));
  }

  bool named_by_map(const FileColumn& column) const {
    return std::ranges::any_of(options_.channels.sources,
                               [&column](const auto& entry) { return entry.second.column == column.name; });
  }

  std::optional<BoundColumn> by_header(Channel channel) const {
    const auto exact = by_header(channel, true);
    return exact ? exact : by_header(channel, false);
  }

  std::optional<BoundColumn> by_header(Channel channel, bool exact) const {
    std::optional<BoundColumn> out;
    for (std::size_t index = 0; index < columns_.size(); ++index) {
      const FileColumn& column = columns_[index];
      const auto header = channel_header(column);
      if (!header || header->channel != channel || header->exact != exact || named_by_map(column)) continue;
      if (out) {
        throw RecordingError(
            fmt::format("{}: columns '{}' and '{}' are both channel {}; rename one of them or choose "
                        "one in a channel map",
                        file_, out->name, column.name, name(channel)));
      }
      refuse_two_units(column, channel, header->unit);
      out = in_unit(index, channel, header->unit);
    }
    return out;
  }

  BoundColumn in_unit(std::size_t index, Channel channel, const std::string& written) const {
    const std::string place = fmt::format("{}, column '{}'", file_, columns_[index].name);
    if (written.empty()) {
      throw RecordingError(fmt::format(
          "{}: has no unit; name it {}_{} or give its unit in a channel map (allowed: "
          "{})",
          place, name(channel), units::unit_named(unit_names(channel).front())->header, listed(unit_names(channel))));
    }
    const units::Unit unit = channel_unit(channel, written, options_.stroke_m, place);
    return {index, channel, unit.factor, unit.offset, columns_[index].name, unit};
  }

  BoundColumn as_time(std::size_t index) const { return in_unit(index, Channel::time, unit_of_time(columns_[index])); }

  const SampleTable& table_;
  const std::vector<FileColumn>& columns_;
  std::vector<UnreadPart> unread_;
  const ReadOptions& options_;
  const std::string& file_;
};

}  // namespace

const BoundColumn* leading_channel(const std::vector<BoundColumn>& bound) {
  for (const Channel channel : {Channel::current, Channel::current_a, Channel::current_b, Channel::position}) {
    const auto found = std::ranges::find(bound, channel, &BoundColumn::channel);
    if (found != bound.end()) return &*found;
  }
  const auto first = std::ranges::find_if(bound, [](const BoundColumn& one) { return one.channel != Channel::time; });
  return first == bound.end() ? nullptr : &*first;
}

std::vector<BoundColumn> bind_channels(const SampleTable& table, const ReadOptions& options, const std::string& file) {
  const Binder binder(table, options, file);
  std::vector<BoundColumn> bound;
  const auto add = [&](Channel channel, bool required) {
    if (channel == Channel::time || std::ranges::count(bound, channel, &BoundColumn::channel) > 0) return;
    if (auto column = binder.bind(channel)) {
      bound.push_back(std::move(*column));
    } else if (required) {
      binder.missing(channel);
    }
  };
  for (const Channel channel : options.required) add(channel, true);
  for (const Channel channel : options.optional) add(channel, false);
  if (options.required.empty() && options.optional.empty()) {
    for (const Channel channel : all_channels) add(channel, false);
  }
  auto time = binder.time(bound);
  if (!time) binder.missing(Channel::time);
  bound.insert(bound.begin(), std::move(*time));
  return bound;
}

std::string unread_channels(const SampleTable& table, const ReadOptions& options, const std::vector<BoundColumn>& bound,
                            const std::string& file) {
  const Binder binder(table, options, file);
  std::vector<Channel> missing;
  for (const Channel channel : all_channels) {
    if (std::ranges::count(options.optional, channel) == 0) continue;  // a required one is bound
    if (std::ranges::count(bound, channel, &BoundColumn::channel) == 0) missing.push_back(channel);
  }
  if (missing.empty()) return {};
  const ChannelMap guessed = binder.guesses();
  const auto named_otherwise = [&](Channel channel) -> std::string {
    const auto found = guessed.sources.find(channel);
    if (found == guessed.sources.end() || std::ranges::count(bound, found->second.column, &BoundColumn::name) > 0)
      return {};
    return fmt::format("column '{}' is not read: if it is {}, name it {}_<unit> or give it in a channel map",
                       found->second.column, name(channel), name(channel));
  };
  std::string out;
  for (const Channel channel : missing) {
    std::string what = binder.unread_as(channel);
    if (what.empty()) what = named_otherwise(channel);
    if (const auto assumed = options.assumed.find(channel); assumed != options.assumed.end())
      what += fmt::format("{}{} is missing: {}", what.empty() ? "" : "; ", name(channel), assumed->second);
    if (!what.empty()) out += (out.empty() ? "" : "; ") + what;
  }
  return out;
}

}  // namespace spoolflow::recording

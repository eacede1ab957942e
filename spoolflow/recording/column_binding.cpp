#include "spoolflow/recording/column_binding.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/recording/recording_error.hpp"
#include "spoolflow/units/unit.hpp"

namespace spoolflow::recording {
namespace {

using units::Dimension;

struct Conversion {
  double scale;
  double offset;
};

/// From a written unit to the channel's SI unit; `what` begins the message.
Conversion to_SI(Channel channel, const std::string& unit_name, const ReadOptions& options, const std::string& what) {
  const Dimension wanted = dimension(channel);
  if (wanted == Dimension::none) return {1, 0};
  const auto unit = units::unit_named(unit_name);
  if (!unit) {
    throw RecordingError(fmt::format("{}: \"{}\" is no known unit; a {} is given in {}", what, unit_name,
                                     units::name(wanted), units::units_of(wanted)));
  }
  if (unit->dimension == wanted) return {unit->scale, unit->offset};
  const bool through_stroke = (wanted == Dimension::length && unit->dimension == Dimension::ratio) ||
                              (wanted == Dimension::ratio && unit->dimension == Dimension::length);
  if (through_stroke && options.stroke_m) {
    return {wanted == Dimension::length ? unit->scale * *options.stroke_m : unit->scale / *options.stroke_m, 0};
  }
  if (through_stroke) {
    throw RecordingError(
        fmt::format("{}: {} is a share of a stroke that is not known here; give the column a scale and "
                    "to = \"mm\" in a channel map",
                    what, unit->name));
  }
  throw RecordingError(fmt::format("{}: {} is a unit of {}, the channel is a {}; allowed are {}", what, unit->name,
                                   units::name(unit->dimension), units::name(wanted), units::units_of(wanted)));
}

std::string listed(const std::vector<FileColumn>& columns) {
  std::string out;
  for (const FileColumn& column : columns) out += (out.empty() ? "\"" : ", \"") + column.name + "\"";
  return out.empty() ? "no columns" : out;
}

bool asked_for(Channel channel, const ReadOptions& options) {
  const auto in = [&](const std::vector<Channel>& list) {
    return std::find(list.begin(), list.end(), channel) != list.end();
  };
  return (options.required.empty() && options.optional.empty()) || in(options.required) || in(options.optional);
}

void bind_by_map(std::vector<ColumnBinding>& bound, const std::vector<FileColumn>& columns, const ReadOptions& options,
                 const std::string& file) {
  for (const auto& entry : options.channels.sources) {
    const Channel channel = entry.first;
    const ChannelSource& source = entry.second;
    if (!asked_for(channel, options)) continue;
    const auto found = std::find_if(columns.begin(), columns.end(),
                                    [&](const FileColumn& column) { return column.name == source.column; });
    if (found == columns.end()) {
      throw RecordingError(fmt::format("{}: no column \"{}\", which {} names for channel {}; the file has {}", file,
                                       source.column, options.channels.place, name(channel), listed(columns)));
    }
    const std::string what = fmt::format("{}: channel {} from column \"{}\"", file, name(channel), source.column);
    std::string unit = source.to ? *source.to : source.unit;
    if (unit.empty()) unit = found->unit;
    if (unit.empty() && dimension(channel) != Dimension::none) {
      throw RecordingError(fmt::format("{}: no unit; add unit = \"…\" in {}, one of {}", what, options.channels.place,
                                       units::units_of(dimension(channel))));
    }
    const Conversion SI = to_SI(channel, unit, options, what);
    bound.push_back({channel, static_cast<std::size_t>(found - columns.begin()), SI.scale * source.scale,
                     SI.scale * source.offset + SI.offset, unit});
  }
}

void bind_by_header(std::vector<ColumnBinding>& bound, const std::vector<FileColumn>& columns,
                    const ReadOptions& options, const std::string& file) {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    Channel channel{};
    std::string unit;
    if (!parse_header(columns[k].name, channel, unit) || !asked_for(channel, options)) continue;
    if (unit.empty()) unit = columns[k].unit;
    const std::string what = fmt::format("{}: column \"{}\"", file, columns[k].name);
    if (unit.empty() && dimension(channel) != Dimension::none) {
      throw RecordingError(fmt::format("{}: no unit; name the column {}_<unit> with one of {}, or use a channel map",
                                       what, name(channel), units::units_of(dimension(channel))));
    }
    const Conversion SI = to_SI(channel, unit, options, what);
    bound.push_back({channel, k, SI.scale, SI.offset, unit});
  }
}

}  // namespace

bool parse_header(const std::string& header, Channel& channel, std::string& unit) {
  std::size_t longest = 0;
  for (const Channel candidate : all_channels()) {
    const std::string_view name_of = name(candidate);
    if (name_of.size() < longest || !header.starts_with(name_of)) continue;
    const std::string rest = header.substr(name_of.size());
    if (!rest.empty() && (rest[0] != '_' || !units::unit_named(rest.substr(1)))) continue;
    longest = name_of.size();
    channel = candidate;
    unit = rest.empty() ? "" : rest.substr(1);
  }
  return longest > 0;
}

std::vector<ColumnBinding> bind_columns(const std::vector<FileColumn>& columns, const ReadOptions& options,
                                        const std::string& file) {
  std::vector<ColumnBinding> bound;
  if (options.channels.sources.empty()) {
    bind_by_header(bound, columns, options, file);
  } else {
    bind_by_map(bound, columns, options, file);
  }
  for (std::size_t a = 0; a < bound.size(); ++a) {
    for (std::size_t b = a + 1; b < bound.size(); ++b) {
      if (bound[a].channel == bound[b].channel) {
        throw RecordingError(
            fmt::format("{}: columns \"{}\" and \"{}\" are both channel {}; keep one, or choose by a channel map", file,
                        columns[bound[a].column].name, columns[bound[b].column].name, name(bound[a].channel)));
      }
    }
  }
  for (const Channel channel : options.required) {
    if (std::none_of(bound.begin(), bound.end(), [&](const ColumnBinding& each) { return each.channel == channel; })) {
      const std::string unit = dimension(channel) == Dimension::none ? "" : "_<unit>";
      throw RecordingError(fmt::format(
          "{}: no channel {}; name a column {}{} or give a channel map ({}), the file has {}", file, name(channel),
          name(channel), unit, "`--channels MAP.toml`; `spoolflow inspect` proposes one", listed(columns)));
    }
  }
  std::sort(bound.begin(), bound.end(),
            [](const ColumnBinding& a, const ColumnBinding& b) { return a.column < b.column; });
  return bound;
}

}  // namespace spoolflow::recording

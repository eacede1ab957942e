#include "spoolflow/recording/read_channel_map.hpp"

#include <cmath>

#include <fmt/format.h>

#include "spoolflow/recording/recording_error.hpp"
#include "spoolflow/recording/toml_place.hpp"

namespace spoolflow::recording {
namespace {

Channel channel_of(const toml::key& key, const toml::node& value, const std::filesystem::path& file) {
  if (const auto channel = channel_named(key.str())) return *channel;
  std::string names;
  for (const Channel channel : all_channels()) names += (names.empty() ? "" : ", ") + std::string(name(channel));
  throw RecordingError(fmt::format("{}: there is no channel \"{}\"; there are {}", place_of(value, file),
                                   std::string(key.str()), names));
}

/// A unit that exists; whether it fits the channel is told where the column is bound.
std::string unit_of(const toml::table& entry, std::string_view key, const std::string& where,
                    const std::filesystem::path& file) {
  std::string unit = text_of(entry, key, where, file);
  if (!units::unit_named(unit)) {
    throw RecordingError(
        fmt::format("{}: {}.{}: \"{}\" is no known unit", place_of(*entry.get(key), file), where, key, unit));
  }
  return unit;
}

double finite_number(const toml::table& entry, std::string_view key, double otherwise, const std::string& where,
                     const std::filesystem::path& file) {
  const toml::node* node = entry.get(key);
  if (node == nullptr) return otherwise;
  const auto number = node->value<double>();
  if (!number || !std::isfinite(*number) || (key == "scale" && *number == 0)) {
    throw RecordingError(fmt::format("{}: {}.{} is no usable number", place_of(*node, file), where, key));
  }
  return *number;
}

}  // namespace

ChannelMap parse_channel_map(const toml::table& channels, const std::filesystem::path& file) {
  ChannelMap out;
  out.place = place_of(channels, file);
  for (const auto& [key, value] : channels) {
    const Channel channel = channel_of(key, value, file);
    const std::string where = fmt::format("channels.{}", std::string(key.str()));
    ChannelSource source;
    if (value.is_string()) {
      source.column = *value.value_exact<std::string>();
    } else if (const toml::table* entry = value.as_table()) {
      refuse_unknown_keys(*entry, {"column", "unit", "scale", "offset", "to"}, where, file);
      source.column = text_of(*entry, "column", where, file);
      if (entry->contains("unit")) source.unit = unit_of(*entry, "unit", where, file);
      if (entry->contains("to")) source.to = unit_of(*entry, "to", where, file);
      source.scale = finite_number(*entry, "scale", 1.0, where, file);
      source.offset = finite_number(*entry, "offset", 0.0, where, file);
    } else {
      throw RecordingError(fmt::format("{}: {} is neither a column name nor a table {{ column = \"…\", unit = \"…\" }}",
                                       place_of(value, file), where));
    }
    out.sources.emplace(channel, std::move(source));
  }
  if (out.sources.empty()) throw RecordingError(fmt::format("{}: the channel map names no channels", out.place));
  return out;
}

ChannelMap read_channel_map(const std::filesystem::path& file) {
  const toml::table table = read_toml(file);
  refuse_unknown_keys(table, {"channels"}, "the channel map", file);
  const toml::table* channels = table["channels"].as_table();
  if (channels == nullptr) {
    throw RecordingError(
        fmt::format("{}: has no [channels] table; `spoolflow inspect RECORDING` proposes one", file.string()));
  }
  return parse_channel_map(*channels, file);
}

}  // namespace spoolflow::recording

#include "spoolflow/recording/channel_map.hpp"

#include <fmt/format.h>

#include "spoolflow/recording/channels/allowed_names.hpp"
#include "spoolflow/recording/channels/channel_unit.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/toml_input.hpp"

namespace spoolflow::recording {
namespace {

std::vector<std::string> channel_names() {
  std::vector<std::string> out;
  for (const Channel channel : all_channels) out.emplace_back(name(channel));
  return out;
}

/// Units are checked here, where the line is known, as far as they can be without the file and the stroke.
void check_units(Channel channel, const ChannelSource& source, const TomlTable& entry) {
  constexpr double any_stroke_m = 1.0;
  if (source.to) {
    (void)channel_unit(channel, *source.to, any_stroke_m, entry.place("to"));
    if (!source.unit.empty() && !units::unit_named(source.unit)) {
      std::vector<std::string> known;
      for (const units::Unit& unit : units::all_units()) known.emplace_back(unit.name);
      throw RecordingError(fmt::format("{}: unit '{}' of channel {} is not known{}; leave it out, or write one of {}",
                                       entry.place("unit"), source.unit, name(channel),
                                       did_you_mean(source.unit, known), listed(known)));
    }
  } else if (!source.unit.empty()) {
    (void)channel_unit(channel, source.unit, any_stroke_m, entry.place("unit"));
  }
}

}  // namespace

ChannelMap read_channels(const TomlTable& channels) {
  const std::filesystem::path& file = channels.file;
  ChannelMap map;
  map.place = place_of(channels.table, file);
  for (const auto& [key, node] : channels.table) {
    const auto channel = channel_named(key.str());
    if (!channel) {
      throw RecordingError(fmt::format("{}: unknown channel '{}'{}; allowed: {}", place_of(node, file), key.str(),
                                       did_you_mean(key.str(), channel_names()), listed(channel_names())));
    }
    if (const auto column = node.value_exact<std::string>()) {  // current = "I_sol", with the file's own unit
      map.sources.emplace(*channel, ChannelSource{*column, ""});
      continue;
    }
    const toml::table* fields = node.as_table();
    if (fields == nullptr) {
      throw RecordingError(fmt::format("{}: channel {} must be written as {} = {{ column = \"...\", unit = \"{}\" }}",
                                       place_of(node, file), key.str(), key.str(), unit_names(*channel).front()));
    }
    const TomlTable entry{*fields, file, fmt::format("channel {}", key.str())};
    entry.allow_only({"column", "unit", "scale", "offset", "to"});
    ChannelSource source;
    source.column = entry.text("column");
    source.unit = entry.optional_text("unit").value_or("");
    source.scale = entry.optional_number("scale").value_or(1.0);
    source.offset = entry.optional_number("offset").value_or(0.0);
    source.to = entry.optional_text("to");
    if (source.scale == 0.0) {
      throw RecordingError(
          fmt::format("{}: the scale of channel {} is zero, which would make every sample the same; "
                      "give the sensor's slope",
                      entry.place("scale"), key.str()));
    }
    check_units(*channel, source, entry);
    map.sources.emplace(*channel, std::move(source));
  }
  if (map.sources.empty()) {
    throw RecordingError(
        fmt::format("{}: the table of channels is empty; write lines such as current = {{ column = "
                    "\"I_sol\", unit = \"mA\" }}, or leave the table out",
                    map.place));
  }
  return map;
}

ChannelMap read_channel_map(const std::filesystem::path& file) {
  const toml::table document = read_toml(file);
  const TomlTable top{document, file, "the file"};
  top.allow_only({"channels"});
  const toml::table* channels = document["channels"].as_table();
  if (channels == nullptr) {
    throw RecordingError(
        fmt::format("{}: holds no table [channels]; a channel map has one, with lines such as current "
                    "= {{ column = \"I_sol\", unit = \"mA\" }}",
                    file.string()));
  }
  return read_channels({*channels, file, "[channels]"});
}

}  // namespace spoolflow::recording

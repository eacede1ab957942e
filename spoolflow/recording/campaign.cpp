#include "spoolflow/recording/campaign.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "spoolflow/recording/nearest_name.hpp"
#include "spoolflow/recording/read_channel_map.hpp"
#include "spoolflow/recording/recording_error.hpp"
#include "spoolflow/recording/toml_place.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::array<std::string_view, 5> protocols{"spring", "solenoid_force_map", "solenoid_dynamic",
                                                    "axial_force_map", "operation"};

Protocol protocol_of(const toml::table& entry, const std::filesystem::path& file) {
  const std::string text = text_of(entry, "protocol", "[[recording]]", file);
  const auto found = std::find(protocols.begin(), protocols.end(), text);
  if (found == protocols.end()) {
    throw RecordingError(fmt::format("{}: there is no protocol \"{}\"; did you mean \"{}\"?",
                                     place_of(*entry.get("protocol"), file), text, nearest_name(text, protocols)));
  }
  return static_cast<Protocol>(found - protocols.begin());
}

std::optional<double> positive_if_given(const toml::table* table, std::string_view key, double to_SI,
                                        const std::filesystem::path& file) {
  if (table == nullptr || !table->contains(key)) return std::nullopt;
  return positive_of(*table, key, "[fluid]", file) * to_SI;
}

CampaignValve valve_of(const toml::table& valve, const std::filesystem::path& file) {
  refuse_unknown_keys(valve, {"name", "rated_flow_L_min", "stroke_mm", "direction"}, "[valve]", file);
  CampaignValve out{text_of(valve, "name", "[valve]", file),
                    units::m3_per_s_from_L_per_min(positive_of(valve, "rated_flow_L_min", "[valve]", file)),
                    units::m_from_mm(positive_of(valve, "stroke_mm", "[valve]", file)), "b"};
  if (valve.contains("direction")) out.direction = text_of(valve, "direction", "[valve]", file);
  if (out.direction != "a" && out.direction != "b") {
    throw RecordingError(fmt::format("{}: valve.direction is \"{}\"; it is \"b\" (flow P to B) or \"a\" (P to A)",
                                     place_of(*valve.get("direction"), file), out.direction));
  }
  if (out.stroke_m > 0.05) {
    throw RecordingError(fmt::format("{}: valve.stroke_mm is {:g}, plausible are up to 50",
                                     place_of(*valve.get("stroke_mm"), file), units::mm_from_m(out.stroke_m)));
  }
  return out;
}

CampaignRecording recording_of(const toml::node& node, const std::filesystem::path& file) {
  const toml::table* entry = node.as_table();
  if (entry == nullptr) throw RecordingError(fmt::format("{}: a [[recording]] is a table", place_of(node, file)));
  refuse_unknown_keys(*entry, {"protocol", "file", "channels"}, "[[recording]]", file);
  CampaignRecording out{
      protocol_of(*entry, file), text_of(*entry, "file", "[[recording]]", file), {}, place_of(*entry, file)};
  if (out.file.is_relative()) out.file = file.parent_path() / out.file;
  std::error_code error;
  if (!std::filesystem::is_regular_file(out.file, error)) {
    throw RecordingError(
        fmt::format("{}: the recording \"{}\" is not there; paths are taken from the campaign's folder",
                    place_of(*entry->get("file"), file), out.file.string()));
  }
  if (const toml::node* channels = entry->get("channels")) {
    if (!channels->is_table()) throw RecordingError(fmt::format("{}: channels is no table", place_of(*channels, file)));
    out.channels = parse_channel_map(*channels->as_table(), file);
  }
  return out;
}

}  // namespace

std::string_view name(Protocol protocol) {
  return protocols[static_cast<std::size_t>(protocol)];
}

std::vector<const CampaignRecording*> Campaign::of(Protocol protocol) const {
  std::vector<const CampaignRecording*> out;
  for (const CampaignRecording& recording : recordings) {
    if (recording.protocol == protocol) out.push_back(&recording);
  }
  return out;
}

Campaign read_campaign(const std::filesystem::path& file) {
  const toml::table table = read_toml(file);
  refuse_unknown_keys(table, {"valve", "fluid", "recording", "instruments"}, "the campaign", file);
  const toml::table* valve = table["valve"].as_table();
  if (valve == nullptr) {
    throw RecordingError(
        fmt::format("{}: has no [valve] table; add one with name, rated_flow_L_min and stroke_mm", file.string()));
  }
  const toml::table* fluid = table["fluid"].as_table();
  if (fluid != nullptr) {
    refuse_unknown_keys(*fluid,
                        {"name", "density_15C_kg_per_m3", "viscosity_40C_mm2_per_s", "viscosity_100C_mm2_per_s"},
                        "[fluid]", file);
  }
  Campaign out{file, valve_of(*valve, file), {}, {}};
  out.fluid.name =
      fluid != nullptr && fluid->contains("name") ? text_of(*fluid, "name", "[fluid]", file) : "not stated";
  out.fluid.density_15C_kg_per_m3 = positive_if_given(fluid, "density_15C_kg_per_m3", 1, file);
  out.fluid.viscosity_40C_m2_per_s =
      positive_if_given(fluid, "viscosity_40C_mm2_per_s", units::m2_per_s_per_mm2_per_s, file);
  out.fluid.viscosity_100C_m2_per_s =
      positive_if_given(fluid, "viscosity_100C_mm2_per_s", units::m2_per_s_per_mm2_per_s, file);
  const toml::array* recordings = table["recording"].as_array();
  if (recordings == nullptr || recordings->empty()) {
    throw RecordingError(
        fmt::format("{}: names no recordings; add [[recording]] tables with protocol and file", file.string()));
  }
  for (const toml::node& node : *recordings) out.recordings.push_back(recording_of(node, file));
  return out;
}

}  // namespace spoolflow::recording

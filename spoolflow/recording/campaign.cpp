#include "spoolflow/recording/campaign.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include <fmt/format.h>

#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/recording/toml_input.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::recording {
namespace {

constexpr std::array<std::string_view, 7> protocol_names{"spring",          "solenoid_force_map",    "solenoid_dynamic",
                                                         "axial_force_map", "unpressurised_strokes", "metering",
                                                         "operation"};

CampaignTolerances tolerances_of(const TomlTable& table) {
  CampaignTolerances out{place_of(table.table, table.file), {}};
  for (const auto& [key, node] : table.table) {
    out.values.emplace(std::string(key.str()), table.positive(key.str()));
    out.places.emplace(std::string(key.str()), table.place(key.str()));
  }
  return out;
}

CampaignInstruments instruments_of(const TomlTable& table) {
  table.allow_only({"position_uncertainty_mm", "current_uncertainty_A", "force_uncertainty_N",
                    "pressure_uncertainty_bar", "temperature_uncertainty_K"});
  CampaignInstruments out;
  const auto read = [&](std::string_view key, double least, double most, std::string_view unit) {
    const std::string otherwise =
        fmt::format("give the half width at 95 % in {}, as the instrument's data sheet has it", unit);
    return table.optional_within(key, {least, most, otherwise});
  };
  if (const auto written = read("position_uncertainty_mm", 1e-4, 0.5, "mm"))
    out.position_uncertainty_m = units::m_from_mm(*written);
  out.current_uncertainty_A = read("current_uncertainty_A", 1e-4, 0.5, "A");
  out.force_uncertainty_N = read("force_uncertainty_N", 1e-3, 50, "N");
  if (const auto written = read("pressure_uncertainty_bar", 1e-3, 20, "bar"))
    out.pressure_uncertainty_Pa = units::Pa_from_bar(*written);
  out.temperature_uncertainty_K = read("temperature_uncertainty_K", 0.01, 20, "K");
  return out;
}

CampaignInstruments unit_instruments_of(const TomlTable& table) {
  table.allow_only({"flow_uncertainty_percent"});
  constexpr NumberRange percents{
      0.05, 20, "give the half width at 95 % in percent of the reading, where it is a share times 100"};
  CampaignInstruments out;
  out.flow_uncertainty_share = 0.01 * table.within("flow_uncertainty_percent", percents);
  return out;
}

CampaignLoad load_of(const TomlTable& table) {
  table.allow_only({"area_ratio"});
  return {table.within("area_ratio", {0.1, 10, "give the piston's area at port A over that at port B"})};
}

/// The edge that an axial-force map or a flow bench's strokes are of, empty where it is of all that the oil passes;
/// `direction` becomes the edge's.
std::string edge_of(const TomlTable& entry, Protocol protocol, std::string& direction) {
  const std::optional<std::string> edge = entry.optional_text("edge");
  if (!edge) return {};
  if (protocol != Protocol::axial_force_map && protocol != Protocol::metering) {
    throw RecordingError(
        fmt::format("{}: edge = \"{}\" stands with protocol \"{}\"; only axial_force_map and "
                    "metering are measured one edge at a time: leave edge out",
                    entry.place("edge"), *edge, name(protocol)));
  }
  for (const char* each : {"b", "a"}) {
    const PathEdges edges = edges_of(each);
    if (*edge != edges.inlet && *edge != edges.outlet) continue;
    if (const std::optional<std::string> written = direction_of(entry); written && *written != each) {
      throw RecordingError(
          fmt::format("{}: edge \"{}\" is of direction \"{}\", and direction = \"{}\" is given; correct "
                      "one of the two, or leave direction out",
                      entry.place("edge"), *edge, each, *written));
    }
    direction = each;
    return *edge;
  }
  throw RecordingError(
      fmt::format("{}: edge \"{}\" is not known; allowed: \"PB\" and \"AT\" (direction b), \"PA\" and "
                  "\"BT\" (direction a), or no edge where the file is of both together",
                  entry.place("edge"), *edge));
}

/// A campaign that came from elsewhere must not make this program read what its user can read.
void refuse_outside(const std::filesystem::path& recording, const TomlTable& entry) {
  const std::filesystem::path folder = std::filesystem::absolute(entry.file).parent_path();  // "" for one named alone
  std::error_code unreadable;
  const auto without_links = [&](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path), unreadable);
  };
  const std::filesystem::path inside = without_links(recording).lexically_relative(without_links(folder));
  if (!unreadable && !inside.empty() && *inside.begin() != "..") return;
  throw RecordingError(
      fmt::format("{}: the recording {} stands outside the campaign's folder; put it there, or allow it with "
                  "--allow-outside",
                  entry.place("file"), recording.string()));
}

CampaignRecording recording_of(const TomlTable& entry, const CampaignValve& valve, OutsideFiles outside) {
  entry.allow_only({"protocol", "file", "direction", "edge", "channels"});
  CampaignRecording out{static_cast<Protocol>(entry.choice("protocol", protocol_names)),
                        entry.file.parent_path() / entry.text("file"),
                        {},
                        place_of(entry.table, entry.file),
                        direction_of(entry).value_or(valve.direction)};
  out.edge = edge_of(entry, out.protocol, out.direction);
  if (outside == OutsideFiles::refused) refuse_outside(out.file, entry);
  std::error_code failure;
  if (!std::filesystem::exists(out.file, failure)) {
    throw RecordingError(fmt::format("{}: the recording {} does not exist; correct file = \"{}\" or put the file there",
                                     entry.place("file"), out.file.string(), entry.text("file")));
  }
  if (const toml::node* channels = entry.table.get("channels")) {
    const toml::table* table = channels->as_table();
    if (table == nullptr) {
      throw RecordingError(fmt::format("{}: channels must be a table, [recording.channels]", entry.place("channels")));
    }
    out.channels = read_channels({*table, entry.file, "[recording.channels]"});
  }
  return out;
}

/// Each direction's axial force is of both edges together, or of each of them.
void require_whole_paths(const Campaign& campaign) {
  std::vector<const CampaignRecording*> maps = campaign.of(Protocol::axial_force_map);
  std::ranges::copy(campaign.of(Protocol::metering), std::back_inserter(maps));
  for (const CampaignRecording* one : maps) {
    if (one->edge.empty()) continue;
    const auto [inlet, outlet] = edges_of(one->direction);
    bool other_edge = false;
    for (const CampaignRecording* each : maps) {
      if (each->direction != one->direction) continue;
      if (each->protocol != one->protocol) {
        if (one->protocol == Protocol::axial_force_map && each->edge.empty()) continue;  // strokes of the whole path
        throw RecordingError(fmt::format(
            "{}: {} is of protocol \"{}\" and {} of \"{}\", both of direction \"{}\"; edges are measured one at a time "
            "by one of the two: leave the other out",
            each->place, each->file.filename().string(), name(each->protocol), one->file.filename().string(),
            name(one->protocol), one->direction));
      }
      if (each->edge.empty()) {
        throw RecordingError(fmt::format(
            "{}: {} names no edge, and {} is of edge {} alone, both of direction \"{}\"; a direction is measured one "
            "edge at a time ({} and {}) or both together: give each file its edge, or none",
            each->place, each->file.filename().string(), one->file.filename().string(), one->edge, one->direction,
            inlet, outlet));
      }
      other_edge = other_edge || each->edge != one->edge;
    }
    if (!other_edge) {
      throw RecordingError(fmt::format(
          "{}: of direction \"{}\" edge {} alone was measured, and the oil also passes {}; add "
          "{} recordings with edge = \"{}\", or leave edge out where the files are of all that the oil passes",
          one->place, one->direction, one->edge, one->edge == inlet ? outlet : inlet, name(one->protocol),
          one->edge == inlet ? outlet : inlet));
    }
  }
}

/// The table `key` of the document; throws where it is missing or of another kind.
TomlTable table_of(const TomlTable& document, std::string_view key) {
  const toml::node* node = document.table.get(key);
  const toml::table* table = node == nullptr ? nullptr : node->as_table();
  if (table == nullptr) {
    throw RecordingError(fmt::format("{}: a campaign needs a table [{}]", document.place(key), key));
  }
  return {*table, document.file, fmt::format("[{}]", key)};
}

/// What the file of a unit may hold beside `valve`, without which it is no campaign.
constexpr std::array<std::string_view, 6> unit_keys{"name",        "fluid",    "instruments",
                                                    "environment", "channels", "recording"};

bool may_be_of_unit(const toml::table& document) {
  for (const auto& [key, node] : document) {
    if (std::ranges::count(unit_keys, key.str()) == 0) return false;
  }
  return true;
}

/// All but valve and instruments.
void read_rest(const TomlTable& document, OutsideFiles outside, Campaign& campaign) {
  const toml::table& read = document.table;
  campaign.file = document.file;
  if (read.contains("fluid")) campaign.fluid = fluid_of(table_of(document, "fluid"));
  if (read.contains("channels")) campaign.channels = read_channels(table_of(document, "channels"));
  if (read.contains("load")) campaign.load = load_of(table_of(document, "load"));
  if (read.contains("environment")) campaign.environment = environment_of(document, "bench");
  if (read.contains("tolerances")) campaign.tolerances = tolerances_of(table_of(document, "tolerances"));
  for (const TomlTable& entry :
       document.tables("recording", "names no recordings; add [[recording]] tables with protocol and file"))
    campaign.recordings.push_back(recording_of(entry, campaign.valve, outside));
  require_whole_paths(campaign);
}

}  // namespace

std::string_view name(Protocol protocol) {
  return protocol_names[static_cast<std::size_t>(protocol)];
}

bool by_own_solenoid(Protocol protocol) {
  return protocol == Protocol::unpressurised_strokes || protocol == Protocol::metering ||
         protocol == Protocol::operation;
}

PathEdges edges_of(std::string_view direction) {
  return direction == "a" ? PathEdges{"PA", "BT"} : PathEdges{"PB", "AT"};
}

std::vector<const CampaignRecording*> Campaign::of(Protocol protocol) const {
  std::vector<const CampaignRecording*> out;
  for (const CampaignRecording& recording : recordings) {
    if (recording.protocol == protocol) out.push_back(&recording);
  }
  return out;
}

Campaign read_campaign(const std::filesystem::path& file, OutsideFiles outside) {
  const toml::table read = read_toml(file);
  const TomlTable document{read, file, "the campaign"};
  if (may_be_of_unit(read)) {
    throw RecordingError(
        fmt::format("{}, line 1: a campaign needs a table [valve]; the file of a unit goes with the "
                    "model of its type: `spoolflow calibrate UNIT.toml --type TYPE.json -o UNIT.json`",
                    file.string()));
  }
  document.allow_only({"valve", "fluid", "instruments", "load", "environment", "tolerances", "channels", "recording"});
  Campaign campaign;
  campaign.valve = valve_of(table_of(document, "valve"));
  if (read.contains("instruments")) campaign.instruments = instruments_of(table_of(document, "instruments"));
  read_rest(document, outside, campaign);
  if (!campaign.environment) campaign.environment = environment_of(document, "bench");
  return campaign;
}

Campaign read_unit_campaign(const std::filesystem::path& file, const CampaignValve& type, OutsideFiles outside) {
  const toml::table read = read_toml(file);
  const TomlTable document{read, file, "the unit"};
  std::vector<std::string> keys(unit_keys.begin(), unit_keys.end());
  keys.emplace_back("valve");
  document.allow_only(keys);
  Campaign campaign;
  campaign.valve = type;
  campaign.valve.name = std::filesystem::absolute(file).lexically_normal().parent_path().filename().string();
  if (read.contains("name")) campaign.valve.name = document.text("name");
  if (read.contains("valve")) campaign.valve = unit_valve_of(table_of(document, "valve"), campaign.valve);
  if (read.contains("instruments")) {
    TomlTable instruments = table_of(document, "instruments");
    instruments.name = "[instruments] of a unit, whose other instruments its type's campaign has";
    campaign.instruments = unit_instruments_of(instruments);
  }
  read_rest(document, outside, campaign);
  return campaign;
}

}  // namespace spoolflow::recording

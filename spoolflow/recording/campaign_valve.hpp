#pragma once
/// What a campaign says of its valve and of the oil: [valve] and [fluid] of campaign.toml.
#include <optional>
#include <string>

namespace spoolflow::recording {

struct TomlTable;

struct CampaignValve {
  std::string name;
  double rated_flow_m3_per_s;  ///< full scale of every % FS figure
  double stroke_m;
  std::string direction = "b";             ///< "b": flow P to B; of the recordings that do not say theirs
  bool simulated = false;                  ///< origin = "simulated": no recording of the campaign was measured
  std::optional<double> open_stop_m{};     ///< what the position channel shows where the spool meets its open stop
  std::optional<double> moving_mass_kg{};  ///< spool, push rod and armature together
};

/// Data-sheet values of the oil; absent where the campaign does not give them.
struct CampaignFluid {
  std::string name;
  std::optional<double> density_15C_kg_per_m3;
  std::optional<double> viscosity_40C_m2_per_s;
  std::optional<double> viscosity_100C_m2_per_s;
};

/// Each throws RecordingError, with the place, for a key that is missing or unknown and a number that no valve or oil
/// has.
[[nodiscard]] CampaignValve valve_of(const TomlTable& table);
/// What a unit's [valve] may say against its type: its name, its open stop, and what agrees with the type.
[[nodiscard]] CampaignValve unit_valve_of(const TomlTable& table, CampaignValve type);
[[nodiscard]] CampaignFluid fluid_of(const TomlTable& table);
/// "a" or "b" of a [valve] or a [[recording]]; nothing where the table does not say.
[[nodiscard]] std::optional<std::string> direction_of(const TomlTable& table);

}  // namespace spoolflow::recording

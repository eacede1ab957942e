#pragma once
/// The bench recordings that together describe one valve (campaign.toml).
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "spoolflow/recording/campaign_valve.hpp"
#include "spoolflow/recording/channel_map.hpp"
#include "spoolflow/recording/environment.hpp"

namespace spoolflow::recording {

enum class Protocol : std::uint8_t {
  spring,
  solenoid_force_map,
  solenoid_dynamic,
  axial_force_map,
  unpressurised_strokes,  ///< the valve strokes by its own solenoid with the pump off
  metering,               ///< the same at held pressure differences, beside a flow meter
  operation
};
inline constexpr std::array all_protocols{
    Protocol::spring,          Protocol::solenoid_force_map,    Protocol::solenoid_dynamic,
    Protocol::axial_force_map, Protocol::unpressurised_strokes, Protocol::metering,
    Protocol::operation};
[[nodiscard]] std::string_view name(Protocol protocol);
/// Whether it is of the valve as a whole, driven by its own solenoid, rather than of a part on a force rig.
[[nodiscard]] bool by_own_solenoid(Protocol protocol);

/// What the instruments of the bench are good for, as 95 % uncertainties in SI; absent where not given.
struct CampaignInstruments {
  std::optional<double> position_uncertainty_m;
  std::optional<double> current_uncertainty_A;
  std::optional<double> force_uncertainty_N;
  std::optional<double> pressure_uncertainty_Pa;
  std::optional<double> temperature_uncertainty_K;
  std::optional<double> flow_uncertainty_share{};  ///< of a unit's flow meter, of its reading
};

/// What the valve moves at its ports.
struct CampaignLoad {
  double area_ratio = 1;  ///< the piston's area at port A over that at port B; 1: both ports pass the same flow
};

/// By what units of the type differ, one standard deviation each, as written: the keys are calibration's.
struct CampaignTolerances {
  std::string place;  ///< "campaign.toml, line 17", for messages
  std::map<std::string, double> values;
  std::map<std::string, std::string> places{};  ///< of each value, like `place`
};

struct CampaignRecording {
  Protocol protocol;
  std::filesystem::path file;  ///< resolved against the campaign's folder
  ChannelMap channels;
  std::string place;            ///< "campaign.toml, line 17", for messages
  std::string direction = "b";  ///< of a file of one direction, whose position counts from the centre, opening > 0
  std::string edge{};  ///< of an axial-force map or strokes on a flow bench of one edge: "PB", "AT", "PA" or "BT";
                       ///< empty: of all that the oil passes
};

/// The edges of a direction's path, in the order in which the oil passes them.
struct PathEdges {
  std::string_view inlet, outlet;
};
/// P to B and A to T of direction "b", P to A and B to T of "a".
[[nodiscard]] PathEdges edges_of(std::string_view direction);

struct Campaign {
  std::filesystem::path file;
  CampaignValve valve;
  CampaignFluid fluid;
  CampaignInstruments instruments;
  CampaignLoad load;
  CampaignTolerances tolerances{};
  std::optional<Environment> environment{};  ///< of the machine that the valve is for; absent: that of the unit's type
  ChannelMap channels{};  ///< of all files that have the columns; a recording's own entries come before it
  std::vector<CampaignRecording> recordings;

  [[nodiscard]] std::vector<const CampaignRecording*> of(Protocol protocol) const;
};

/// Whether a campaign may name recordings outside its own folder: by "..", by a whole path, by a symbolic link.
enum class OutsideFiles : std::uint8_t { refused, allowed };

/// Throws RecordingError with file and line: unknown keys, missing or non-positive values, a recording that does not
/// exist, or that stands outside where that is refused, an edge that is not of its direction, a path of which one edge
/// alone was measured.
[[nodiscard]] Campaign read_campaign(const std::filesystem::path& file, OutsideFiles outside = OutsideFiles::refused);

/// The recordings of one unit of a type. [valve] may be absent, or say no more than the unit's name; so may the whole
/// file, by `name = "…"` at its top. [instruments] has its flow meter alone. All else is the type's, and the name is
/// the file's folder where none is given.
[[nodiscard]] Campaign read_unit_campaign(const std::filesystem::path& file, const CampaignValve& type,
                                          OutsideFiles outside = OutsideFiles::refused);

}  // namespace spoolflow::recording

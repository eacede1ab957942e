#pragma once
/// Where a model came from.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::model {

struct InputFile {
  std::string protocol;     ///< as in the campaign, or "campaign" for the campaign file itself
  std::string file;         ///< as written in the campaign
  std::string sha256;       ///< 64 hexadecimal digits
  std::uint64_t samples;    ///< rows read; 0 for the campaign file
  std::string resampled{};  ///< what of it was brought onto the time of its current; reported, not written to the model
};

/// One number that was put right after calibration.
struct Correction {
  std::string direction;  ///< "b" or "a"
  std::string of;         ///< "friction ratio", …
  std::string unit;       ///< SI; "1" for ratios and shares
  double value;           ///< against the model that it was applied to
  double uncertainty_95;  ///< half width about `value`, >= 0
};

/// Where references have moved a model to, against the model as it was calibrated (calibration/references).
struct WearState {
  double edge_width = 0;       ///< conductance and flow force with it, as a share more
  double friction_ratio = 1;   ///< friction in operation over what it was
  double position_zero_m = 0;  ///< the position sensor reads so much too much
  double flow_share = 0;       ///< standard uncertainty of the flow that is left of it, in the band
  double friction_share = 0;   ///< the same of friction
  [[nodiscard]] bool operator==(const WearState&) const = default;
};

/// Corrections of the model from the valve's operation (monitor/adaptation.hpp), or from what its machine knows. The
/// recordings it is from stand among the provenance's inputs, as of protocol `adaptation_protocol`.
struct Adaptation {
  std::string tool_version;
  std::string created;             ///< UTC, ISO 8601
  std::string adapted_from;        ///< sha256 of the model file that was corrected
  std::vector<std::string> files;  ///< recordings, by their names among the inputs
  std::vector<Correction> corrections;
  std::vector<std::string> reasons = {};  ///< a sentence each
  std::optional<WearState> wear = {};     ///< the model's after it, where references moved it or left it
  std::string direction = {};             ///< of a whole valve: which one `wear` is of, "b" or "a"
};
inline constexpr std::string_view adaptation_protocol = "adaptation";

/// `of` of the row on what the scale of all newtons is known by: pages show it apart.
inline constexpr std::string_view scale_of_forces = "scale of all forces";

/// How one quantity of the valve is known.
struct KnownQuantity {
  std::string direction;                      ///< "b" or "a"
  std::string of;                             ///< "spring force", …
  std::string how;                            ///< "measured", "inferred" or "assumed"
  std::string from;                           ///< which recordings show it and by what; what is assumed
  std::string unit;                           ///< of the uncertainty, SI; "1": as a share of the quantity
  std::optional<double> uncertainty_95 = {};  ///< half width, >= 0; absent: no recording shows it
};

struct Provenance {
  std::string tool_version;
  std::string created;  ///< UTC, ISO 8601
  std::vector<InputFile> inputs;
  std::vector<Adaptation> adaptations = {};    ///< oldest first
  std::vector<std::string> doubts = {};        ///< what physics says against the recordings, a sentence each
  bool simulated = false;                      ///< the campaign says that its recordings are
  std::vector<KnownQuantity> quantities = {};  ///< of a type and its units as those of the valve the type was made from
};

/// The state into which references have last moved the model of one direction; none: as calibrated.
[[nodiscard]] WearState last_wear(const Provenance& provenance);

/// Throws std::runtime_error where the file cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& file);
[[nodiscard]] std::string sha256_of_text(std::string_view text);
/// The present moment in seconds since 1970, UTC; SOURCE_DATE_EPOCH overrides it for reproducible files.
/// Throws std::invalid_argument where that is no whole number from 0 to the end of the year 2199.
[[nodiscard]] std::int64_t creation_seconds();
/// The same in UTC, ISO 8601 to the second.
[[nodiscard]] std::string creation_time();
/// Seconds since 1970 of such a text; nothing where it is none.
[[nodiscard]] std::optional<std::int64_t> seconds_of(const std::string& utc);

}  // namespace spoolflow::model

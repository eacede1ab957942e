#pragma once
/// The machine around a valve, as its user knows it: [environment] of a campaign, or a file of its own.
#include <optional>
#include <string>

namespace spoolflow::recording {

struct TomlTable;

/// What a machine leaves open that a bench knows. Half widths at 95 %, SI; the defaults are those of the bench: none.
struct Environment {
  std::string kind = "bench";          ///< "bench" or "machine": whose defaults the rest began with
  double position_zero_m = 0;          ///< of the position sensor's zero after an exchange
  double position_gain = 0;            ///< of its gain, as a share
  double viscosity = 0;                ///< of the oil's viscosity at a temperature, as a share
  double temperature_K = 0;            ///< of the oil at the edge: error and lag of the sensor
  double density = 0;                  ///< of the oil, as a share; air in it counts
  double current_gain = 0;             ///< of the current, as a share
  double pwm_ripple = 0;               ///< of a current that is sampled, not averaged: peak to peak, as a share of it
  double leakage_m3_per_s = 0;         ///< past the metering edge
  double friction = 0;                 ///< as a share
  double vibration_m_per_s2 = 0;       ///< amplitude of the valve's acceleration along the spool
  double dithered_loop = 0;            ///< of the magnetic loop under dither, as a share of half its width
  double ripple_Pa = 0;                ///< amplitude of the pressure difference's ripple
  std::optional<double> highest_Pa{};  ///< pressure difference up to which the valve is used; absent: 1.2 times the
                                       ///< calibrated one
};

/// A valve in a machine of which nothing is known. Sources stand in docs/environment.md.
[[nodiscard]] Environment machine_environment();

/// "bench", "machine", or a TOML file with a table [environment], whose keys replace the defaults of `kind` (machine
/// where it does not say). Throws RecordingError with file and line: unknown keys, values that are no number or out of
/// range.
[[nodiscard]] Environment read_environment(const std::string& name_or_file);

/// The table [environment] of a campaign, or environment = "machine"; the bench where there is none.
/// (toml_input.hpp). `usual_kind` is that of a table that does not say.
[[nodiscard]] Environment environment_of(const TomlTable& document, const std::string& usual_kind);

}  // namespace spoolflow::recording

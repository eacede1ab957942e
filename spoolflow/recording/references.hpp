#pragma once
/// What a machine knows of the oil that passed its valve: [[reference]] of a TOML file.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace spoolflow::recording {

enum class ReferenceKind : unsigned char {
  stroke,  ///< a cylinder that goes from end to end takes a known volume
  pump,    ///< a fixed pump has a known flow while this valve alone is open
  meter,   ///< a flow meter, for as long as it is there: channel flow_reference
  closed   ///< the spool stands closed without current and passes nothing
};
[[nodiscard]] std::string_view name(ReferenceKind kind);

/// How the ends of a stroke are seen.
enum class EndsSeen : unsigned char {
  marks,      ///< times in a file
  pressure,   ///< channel pressure_difference falls while the piston stands
  by_switch,  ///< channel `test` is not zero while the piston stands
  stalled     ///< by the valve's own forces: the pressure difference is gone while the valve is open
};

/// A time from which to which the reference holds, in the recording's own time.
struct TimeMark {
  double begin_s, end_s;
  double speed_rad_per_s;  ///< of a pump, mean; NaN: the reference's own
};

/// SI. Uncertainties are half widths at 95 %; shares of the value where the unit says so.
struct Reference {
  ReferenceKind kind{};
  std::string name;       ///< for messages: as given, or its kind and number, "stroke 1"
  std::string recording;  ///< name of the one file that it holds for; empty: all
  std::string place;      ///< "references.toml, line 12"
  std::string direction;  ///< of flow through the valve that it is of, "b" (P to B) or "a"; empty: not said
  EndsSeen ends{};        ///< of a stroke; `marks` of a pump
  std::vector<TimeMark> marks;
  std::filesystem::path marks_file;                         ///< that they stand in; empty: none
  double area_m2 = 0, length_m = 0;                         ///< of a stroke: what the port fills
  double displacement_m3_per_rad = 0, speed_rad_per_s = 0;  ///< of a pump
  double leakage_m3_per_s = 0;                              ///< of a pump: what it loses at work
  double share_uncertainty = 0;                             ///< of area, displacement or the meter's gain
  double length_uncertainty_m = 0;                          ///< of each stroke
  double leakage_uncertainty_m3_per_s = 0;  ///< past the piston, of the pump's loss, or the meter's zero
  double compression_m3 = 0;                ///< that the oil column takes up at the most, of which half is counted
  double interval_s = 0;                    ///< over which a meter is averaged
};

/// All references of a file. Throws RecordingError with file, line, key, value and what is allowed.
[[nodiscard]] std::vector<Reference> read_references(const std::filesystem::path& file);

}  // namespace spoolflow::recording

#pragma once
/// What a healthy valve showed, kept to compare the same valve with later.
#include <array>
#include <cstdint>
#include <string>

#include "spoolflow/model/model.hpp"
#include "spoolflow/monitor/fault_parameters.hpp"

namespace spoolflow::monitor {

/// Of one side.
struct DirectionBaseline {
  Magnitudes centre{};                 ///< in usual_fault, against the model
  Magnitudes spread = healthy_spread;  ///< one standard deviation about it
  double windows = 0;                  ///< it was learnt from
  double resistance_Ohm = 0;           ///< of the winding; 0: not learnt
};

struct Baseline {
  std::uint64_t model = 0;  ///< fingerprint of the model against which it was learnt
  std::array<DirectionBaseline, 2> side{};
  double dither_amplitude_A = 0;   ///< of the electronics' dither; 0: none was found
  double dither_frequency_Hz = 0;  ///< likewise
};

/// A hash of the model's parameters, the same wherever it was read.
[[nodiscard]] std::uint64_t fingerprint(const model::Model& model);

/// As one JSON object: the member "baseline" of what `spoolflow monitor --json` writes.
[[nodiscard]] std::string baseline_text(const Baseline& baseline);

/// From the whole of such a file. Throws ModelError with the file, the JSON path and the remedy: no JSON, no baseline
/// in it, a number that is missing or beyond its range.
[[nodiscard]] Baseline parse_baseline(const std::string& text, const std::string& file);

}  // namespace spoolflow::monitor

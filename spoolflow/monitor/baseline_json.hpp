#pragma once
/// A baseline as JSON text: the member "baseline" of what `spoolflow monitor --json` writes.
#include <string>

#include "spoolflow/monitor/baseline.hpp"

namespace spoolflow::monitor {

/// One JSON object.
[[nodiscard]] std::string baseline_text(const Baseline& baseline);

/// From the whole of such a file. Throws ModelError with the file, the JSON path and the remedy: no JSON, no baseline
/// in it, a number that is missing or beyond its range.
[[nodiscard]] Baseline parse_baseline(const std::string& text, const std::string& file);

}  // namespace spoolflow::monitor

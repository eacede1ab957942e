#pragma once
/// The summary of an estimate as a piece's outcome, to the last digit.
#include <string>

#include "spoolflow/validation/estimate_summary.hpp"

namespace spoolflow::apps {

[[nodiscard]] std::string text_of(const validation::EstimateSummary& summary);
/// Throws fleet::PieceError.
[[nodiscard]] validation::EstimateSummary read_summary(const std::string& text);

}  // namespace spoolflow::apps

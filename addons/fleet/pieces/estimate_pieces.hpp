#pragma once
/// `estimate`: a piece a recording.
#include <filesystem>
#include <vector>

#include "addons/fleet/jobs/piece.hpp"
#include "spoolflow/apps/estimate_work.hpp"

namespace spoolflow::apps {

/// For Elsewhere::estimate.
[[nodiscard]] std::vector<validation::EstimateSummary> estimate_by_fleet(
    const EstimateTask& task, const EstimateArguments& arguments, const std::vector<std::filesystem::path>& targets);
/// The piece of kind "estimate".
[[nodiscard]] fleet::Outcome do_estimate_piece(const fleet::Piece& piece);

}  // namespace spoolflow::apps

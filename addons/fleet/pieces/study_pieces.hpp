#pragma once
/// Runs of a global study as pieces: so many one after another that starting a process does not count.
#include <string>

#include "addons/fleet/jobs/piece.hpp"
#include "spoolflow/apps/elsewhere.hpp"

namespace spoolflow::apps {

/// For Elsewhere::study. Keeps a reference to the scenario.
[[nodiscard]] analysis::RunsWork study_by_fleet(const StudyInputs& inputs);

/// The piece of kind "study"; `identity` of the program as in StudyWork.
[[nodiscard]] fleet::Outcome do_study_piece(const fleet::Piece& piece, const std::string& identity);

}  // namespace spoolflow::apps

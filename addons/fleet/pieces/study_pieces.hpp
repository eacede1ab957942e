#pragma once
/// Runs of a global study as pieces: so many one after another that starting a process does not count.
#include <string>

#include "spoolflow/analysis/study.hpp"
#include "addons/fleet/pieces/fleet_work.hpp"

namespace spoolflow::apps {

/// What a study is made from.
struct StudyInputs {
  std::string model_file;  ///< the given model's
  std::string direction;   ///< of a whole valve's model the one that is studied
  const analysis::Scenario& scenario;
  std::string scenario_file;  ///< from which it was read; empty: none
};

/// For StudyWork::elsewhere. Keeps references.
[[nodiscard]] analysis::RunsWork runs_by_fleet(FleetWork& fleet, const StudyInputs& inputs);

/// The piece of kind "study"; `identity` of the program as in StudyWork.
[[nodiscard]] fleet::Outcome do_study_piece(const fleet::Piece& piece, const std::string& identity);

}  // namespace spoolflow::apps

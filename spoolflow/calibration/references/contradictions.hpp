#pragma once
/// References that contradict forces or each other.
#include <string>
#include <vector>

#include "spoolflow/calibration/references/wear_search.hpp"

namespace spoolflow::calibration {

/// Throws CalibrationError with the likely cause where a reference cannot be right: too many of its intervals lie apart
/// from its others (another consumer), slow strokes take more than fast ones (a leaking seal), or references differ by
/// more than was stated (a wrong area or displacement). Returns a sentence for each reference whose intervals were left
/// out in part.
[[nodiscard]] std::vector<std::string> require_agreement(const MachineEvidence& evidence, const WearView& view);

/// Throws where less oil passed than forces say by more than a model errs: wear opens edges.
void require_no_less(const MachineEvidence& evidence, const Change& edge);

/// Throws where more oil passed than forces say by so much that a misstated area, displacement or gain is far likelier
/// than wear.
void require_no_misstated(const MachineEvidence& evidence, const EdgeChange& edge);

/// What else than wear may be the cause of wider edges: a misstated area, displacement or gain, and how likely. Empty
/// where several references say the same, or no more oil passes than the model errs by.
[[nodiscard]] std::string looks_alike(const MachineEvidence& evidence, const EdgeChange& edge);

/// "boom, pump": all that say how much oil passed.
[[nodiscard]] std::string names_of(const MachineEvidence& evidence);

}  // namespace spoolflow::calibration

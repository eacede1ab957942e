#pragma once
/// Channels of a TDMS file that pause while others go on.
#include <string>
#include <vector>

#include "spoolflow/recording/channels/even_times.hpp"
#include "spoolflow/recording/tdms/tdms_contents.hpp"

namespace spoolflow::recording {

/// Of each channel why the times of its samples are not known, empty where they are: it has no samples in a segment in
/// which others go on, and then goes on itself at a time that follows its last sample without a gap, late against the
/// others by what they recorded meanwhile. A slow channel that is written every few segments is not late then.
/// `times`: of each channel, as its wf_ properties state them; empty of one that states none.
[[nodiscard]] std::vector<std::string> why_samples_slide(const TdmsContents& contents,
                                                         const std::vector<EvenTimes>& times);

}  // namespace spoolflow::recording

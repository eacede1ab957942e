#pragma once
#include <string>

#include "spoolflow/analysis/run_analysis.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/channel_map.hpp"

namespace spoolflow::apps {

/// A run along which a budget is made up.
struct AnalysedRun {
  analysis::RunSamples samples;
  std::string resampled;  ///< which columns had a time of their own; empty: none
};

/// Throws RecordingError, also where it is a run of a whole valve, which goes through both directions.
[[nodiscard]] AnalysedRun read_analysed_run(const model::Model& model, const std::string& file,
                                            recording::ChannelMap channels);

}  // namespace spoolflow::apps

#pragma once
/// One recording through the sensor into a file, as `estimate` does it.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/plausibility/run_findings.hpp"
#include "spoolflow/recording/channel_map.hpp"
#include "spoolflow/recording/written_tables/table_format.hpp"
#include "spoolflow/validation/estimate_summary.hpp"

namespace spoolflow::apps {

/// What all recordings of one command have in common.
struct EstimateTask {
  model::Model model;
  estimation::Estimator estimator;
  recording::ChannelMap channels;
  std::vector<plausibility::KnownValve> known;  ///< what its recordings should be of
  std::vector<std::filesystem::path> inputs;
  std::optional<recording::TableFormat> format;  ///< of the estimates; nothing: as their names say
  bool quiet;
};

/// Reads the model and the channel map. Throws std::invalid_argument where one of them cannot be used.
[[nodiscard]] EstimateTask estimate_task(const EstimateArguments& arguments);

/// Of the file `target`: as asked for, else as its name says.
[[nodiscard]] recording::TableFormat format_for(const EstimateTask& task, const std::filesystem::path& target);

/// `beside`: whether reading, estimating and writing may have a thread each. Throws std::invalid_argument where the
/// recording cannot be used, OutputError where the estimate cannot be written; then nothing stands at `target`.
[[nodiscard]] validation::EstimateSummary estimate_recording(const EstimateTask& task, const std::string& recording,
                                                             const std::filesystem::path& target, bool beside);

}  // namespace spoolflow::apps

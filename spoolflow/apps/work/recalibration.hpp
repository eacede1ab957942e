#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "spoolflow/calibration/references/recalibrate.hpp"
#include "spoolflow/recording/channel_map.hpp"
#include "spoolflow/recording/references.hpp"

namespace spoolflow::apps {

/// What a machine knows of its oil.
struct MachineOil {
  std::vector<std::filesystem::path> recordings;  ///< files of the valve at work, oldest first
  recording::ChannelMap channels;
  std::vector<recording::Reference> references;
};

/// calibration::recalibrate() from those recordings, which stand among the inputs of the model's provenance afterwards.
/// What physics says against them is among its doubts, the last reasons of the log, and behind a refusal. Throws what
/// it throws, and std::invalid_argument for a recording that is too short.
[[nodiscard]] calibration::RecalibratedValve recalibrated(const model::Model& model, const MachineOil& from,
                                                          model::Adaptation how);

}  // namespace spoolflow::apps

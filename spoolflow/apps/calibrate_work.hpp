#pragma once
/// One campaign into a model file, as `calibrate` does it.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "spoolflow/apps/command_arguments.hpp"
#include "spoolflow/calibration/calibrate.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/campaign.hpp"

namespace spoolflow::apps {

/// One campaign, and what is made of it.
struct CalibrationTask {
  std::string campaign;
  std::string model;   ///< to write
  std::string report;  ///< likewise; empty: none
};

/// A model and the text of its file; read and written again, its axes may differ in their last digits.
struct MadeModel {
  model::Model model;
  std::string text;
};

/// The campaign's own file first.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const recording::Campaign& campaign);

/// Throws std::invalid_argument where the file is no campaign or names files outside its folder that are not allowed.
[[nodiscard]] recording::Campaign read_campaign(const CalibrateArguments& arguments, const std::string& file);

[[nodiscard]] model::Model calibrated(const recording::Campaign& campaign, bool despite_doubts,
                                      const calibration::CalibrationProgress& progress);

/// Writes what `make` makes of the task's campaign, and the report where one is asked for.
void calibrate_one(const CalibrateArguments& arguments, const CalibrationTask& task,
                   const std::function<MadeModel(const recording::Campaign&)>& make);

}  // namespace spoolflow::apps

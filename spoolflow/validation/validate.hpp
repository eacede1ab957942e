#pragma once
/// Judges a model's estimators on recordings with a reference flow.
#include <filesystem>
#include <functional>
#include <vector>

#include "spoolflow/model/model.hpp"
#include "spoolflow/validation/validation.hpp"

namespace spoolflow::validation {

/// `progress` is called with the share of all recordings that was read. Memory grows with the longest recording (about
/// 110 bytes a sample) and with those that do not show their meter's lag, not with the number of the others. Throws
/// RecordingError and ModelError.
[[nodiscard]] Validation validate(const model::Model& model, const std::vector<std::filesystem::path>& recordings,
                                  const ValidationOptions& options, const std::function<void(double)>& progress);

}  // namespace spoolflow::validation

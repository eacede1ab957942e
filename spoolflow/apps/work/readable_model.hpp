#pragma once
#include <string>

#include "spoolflow/model/model.hpp"

namespace spoolflow::apps {

/// The text of a model's file, never one that no command would read: throws CalibrationError instead. `file` names it
/// in the message.
[[nodiscard]] std::string readable_text(const model::Model& model, const std::string& file);

}  // namespace spoolflow::apps

#include "spoolflow/apps/work/readable_model.hpp"

#include <sstream>

#include <fmt/format.h>

#include "spoolflow/calibration/numerics/calibration_error.hpp"

namespace spoolflow::apps {

std::string readable_text(const model::Model& model, const std::string& file) {
  std::ostringstream text;
  model::write_model(text, model);
  try {
    (void)model::parse_model(text.str(), file);
  } catch (const model::ModelError& error) {
    throw calibration::CalibrationError(fmt::format(
        "the recordings make a model that cannot be ({}); nothing was written; look at their channels, signs "
        "and units",
        error.what()));
  }
  return std::move(text).str();
}

}  // namespace spoolflow::apps

#pragma once
/// One type's model from the campaigns of several of its units.
#include "spoolflow/apps/command_arguments.hpp"

namespace spoolflow::apps {

/// Calibrates each campaign, writes the model of the middle of all with the spread between them, and prints that.
void calibrate_type(const CalibrateArguments& arguments);

}  // namespace spoolflow::apps

#pragma once
/// Oil temperatures in another unit than their column says.
#include <string>

#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// One sentence where the run's median is far above all that the valve was calibrated at, or no oil's, and another unit
/// puts it there; else empty. Oil that is only cold, or hot without such an explanation, is none.
[[nodiscard]] std::string temperature_in_another_unit(const recording::Recording& run,
                                                      const model::Range& calibrated_K);

}  // namespace spoolflow::plausibility

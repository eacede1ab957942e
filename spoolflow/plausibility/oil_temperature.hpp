#pragma once
/// Oil temperatures in another unit than their column says, or that no oil has.
#include <string>

#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// One sentence where the run's median is far above all that the valve was calibrated at, or no oil's, and another unit
/// puts it there; else empty. Oil that is only cold, or hot without such an explanation, is none.
[[nodiscard]] std::string temperature_in_another_unit(const recording::Recording& run,
                                                      const model::Range& calibrated_K);

/// One sentence where the oil temperature of a run leaps by 15 K and more, and stays there for 2 s. Empty: none.
[[nodiscard]] std::string leaping_temperature(const recording::Recording& run);

}  // namespace spoolflow::plausibility

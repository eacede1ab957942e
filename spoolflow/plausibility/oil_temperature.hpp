#pragma once
/// Oil temperatures in another unit than their column says, or that no oil has.
#include <string>
#include <string_view>

#include "spoolflow/model/model.hpp"
#include "spoolflow/recording/recording.hpp"

namespace spoolflow::plausibility {

/// Oil of the benches of a campaign, of which nothing else is known: none of them keeps it hotter or colder.
inline constexpr model::Range bench_oil_K{273.15, 353.15};

/// One sentence where the run's median is far above all that its oil is expected at, or no oil's, and another unit puts
/// it there; else empty. Oil that is only cold, or hot without such an explanation, is none. `whence` begins the clause
/// that says what is expected.
[[nodiscard]] std::string temperature_in_another_unit(const recording::Recording& run, const model::Range& expected_K,
                                                      std::string_view whence);

/// One sentence where the oil temperature of a run leaps by 15 K and more, and stays there for 2 s. Empty: none.
[[nodiscard]] std::string leaping_temperature(const recording::Recording& run);

}  // namespace spoolflow::plausibility

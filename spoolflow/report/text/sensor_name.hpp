#pragma once
#include <string_view>

#include "spoolflow/estimation/estimator.hpp"

namespace spoolflow::report {

/// As it stands in a sentence after "the": "condensed sensor", "observer".
[[nodiscard]] constexpr std::string_view sensor_name(estimation::Estimator estimator) {
  return estimator == estimation::Estimator::condensed ? "condensed sensor" : "observer";
}

}  // namespace spoolflow::report

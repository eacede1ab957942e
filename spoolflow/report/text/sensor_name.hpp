#pragma once
#include <string_view>

#include "spoolflow/validation/estimator.hpp"

namespace spoolflow::report {

/// As it stands in a sentence after "the": "condensed sensor", "observer".
[[nodiscard]] constexpr std::string_view sensor_name(validation::Estimator estimator) {
  return estimator == validation::Estimator::condensed ? "condensed sensor" : "observer";
}

}  // namespace spoolflow::report

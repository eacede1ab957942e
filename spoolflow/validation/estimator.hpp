#pragma once
#include <string_view>

namespace spoolflow::validation {

/// The sensors that a model can run.
enum class Estimator { condensed, observer };
[[nodiscard]] std::string_view name(Estimator estimator);

}  // namespace spoolflow::validation

#pragma once
#include <string>

#include "spoolflow/validation/run_result.hpp"

namespace spoolflow::report {

/// A run's trace as web/src/run_data.ts reads it, safe inside a <script> element. Empty where the run has no sample.
[[nodiscard]] std::string trace_json(const validation::RunResult& run, double full_scale_m3_per_s);

}  // namespace spoolflow::report

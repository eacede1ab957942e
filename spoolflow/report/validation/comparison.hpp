#pragma once
/// Validations of other valves, models or times beside the one at hand.
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

/// A figures file that cannot be used.
struct MetricsError : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// What one estimator reached over all runs of a validation; in % of that valve's full scale.
struct ComparedEstimator {
  std::string name;
  double p95, rms, largest, bias, band_coverage_percent, band_mean_width;
  std::vector<double> pressure_difference_Pa = {}, p95_over_pressure = {};  ///< middle of each bin
};

struct ComparedValidation {
  std::string valve, file;
  double full_scale_m3_per_s;
  std::size_t runs;
  std::vector<ComparedEstimator> estimators = {};  ///< those with a reference flow; the leading one last
};

/// What an earlier `validate --json` wrote (docs/formats/metrics.md). Throws MetricsError with the file and the key.
[[nodiscard]] ComparedValidation read_compared(const std::filesystem::path& metrics_file);

/// A section with all of them side by side; nothing where there is nothing to compare with.
void show_comparison(HtmlPage& page, const model::Model& model, const validation::Validation& validation,
                     const std::vector<ComparedValidation>& others);

}  // namespace spoolflow::report

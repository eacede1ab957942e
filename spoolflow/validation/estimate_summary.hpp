#pragma once
/// What the estimate of a whole recording amounts to.
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "spoolflow/plausibility/run_means.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/sensor/basis/sample.hpp"
#include "spoolflow/sensor/basis/status.hpp"

namespace spoolflow::validation {

struct EstimateSummary {
  std::string file;
  std::uint64_t samples = 0;
  double flow_sum_m3_per_s = 0;                                          ///< of all samples
  double width_sum_m3_per_s = 0;                                         ///< of the 95 % band
  std::array<std::uint64_t, sensor::status_names.size()> with_status{};  ///< samples; in the order of the names
  std::uint64_t with_fault = 0;                                          ///< samples with any fault
  recording::ReadNotes notes{};
  std::vector<std::string> doubts{};  ///< what physics says against the run

  void add(std::span<const sensor::Estimate<double>> estimates);
  /// "run.csv: 47000 samples; closed 12.0 %, …", in the order of the shares.
  [[nodiscard]] std::string sentence(double rated_flow_m3_per_s) const;
};

}  // namespace spoolflow::validation

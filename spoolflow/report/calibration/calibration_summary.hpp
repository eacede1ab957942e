#pragma once
/// A calibrated valve in a dozen figures, each beside what is usual.
#include <string>
#include <vector>

#include "spoolflow/model/model.hpp"

namespace spoolflow::report {

struct SummaryLine {
  std::string of;     ///< "spring rate"
  std::string value;  ///< as written
  std::string unit;
  bool usual;
  std::string usually;  ///< "0.5 to 200 N/mm"
};

/// Of a model of one direction: springs, friction, largest magnetic and flow force, coil resistance, what each fit
/// leaves.
[[nodiscard]] std::vector<SummaryLine> calibration_summary(const model::Model& model);

}  // namespace spoolflow::report

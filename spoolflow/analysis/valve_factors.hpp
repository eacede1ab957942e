#pragma once
/// What differs from one valve, oil and set of instruments to the next on the virtual rig, in groups: the factors of
/// the global study.
#include <string>
#include <vector>

#include "spoolflow/analysis/scenario.hpp"
#include "spoolflow/rig/bench/valve_under_test.hpp"

namespace spoolflow::analysis {

/// What one would do about a factor: give the sensor's sub-model what it lacks, or buy a better instrument.
enum class FactorKind { sub_model, instrument };

/// A group of numbers that change together.
struct Factor {
  std::string name;
  FactorKind kind;
  unsigned numbers;
};
[[nodiscard]] const std::vector<Factor>& valve_factors();

/// One valve with its instruments, and the oil's temperature.
struct DrawnValve {
  rig::ValveUnderTest valve;
  double oil_temperature_C;
};

/// `uniform`: as many numbers in (0, 1) as all factors hold, factor after factor. Stays inside every described range.
[[nodiscard]] DrawnValve drawn_valve(const rig::ValveUnderTest& nominal, const SpreadSettings& spread,
                                     const std::vector<double>& uniform);

}  // namespace spoolflow::analysis

#pragma once
#include "spoolflow/report/text/reader_units.hpp"

namespace spoolflow::report {

inline const ReaderUnits& american() {
  static const ReaderUnits units({"gal/min", "psi", "in", "F", "lbf"});
  return units;
}

inline constexpr double per_L_min = 1 / 60000.0;  ///< in m3/s

}  // namespace spoolflow::report

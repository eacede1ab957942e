#include "spoolflow/estimation/columns.hpp"

namespace spoolflow::estimation {

void run(RunningSensor& sensor, const Columns& columns, std::span<sensor::Estimate<double>> estimates) {
  run(sensor, columns, [&](std::size_t k, const sensor::Estimate<double>& estimate) { estimates[k] = estimate; });
}

}  // namespace spoolflow::estimation

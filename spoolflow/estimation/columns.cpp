#include "spoolflow/estimation/columns.hpp"

namespace spoolflow::estimation {

void run(RunningSensor& sensor, const Columns& columns, std::span<sensor::Estimate<double>> estimates) {
  for (std::size_t k = 0; k < columns.size(); ++k) sensor.step(columns[k], estimates[k]);
}

}  // namespace spoolflow::estimation

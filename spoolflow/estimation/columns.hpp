#pragma once
/// From columns of samples to answers: the one way through which a sensor meets what was recorded, simulated or sent.
#include <concepts>
#include <span>

#include "spoolflow/estimation/running_sensor.hpp"

namespace spoolflow::estimation {

/// One sample after the other, as in the valve: calls `each(k, estimate)` after sample k, when sensor.state() is that
/// after the sample. A sensor goes on where it was, so that columns may come in pieces.
/// `Samples`: Columns, or whatever else holds a TimedSample at each index.
template <class Samples, std::invocable<std::size_t, const sensor::Estimate<double>&> Each>
void run(RunningSensor& sensor, const Samples& samples, Each&& each) {
  for (std::size_t k = 0; k < samples.size(); ++k) each(k, sensor.step(samples[k]));
}

/// One estimate a sample, in `estimates`, which is as long as the columns. Compiled here once, at the library's own
/// optimisation, whatever the caller's is.
void run(RunningSensor& sensor, const Columns& columns, std::span<sensor::Estimate<double>> estimates);

}  // namespace spoolflow::estimation

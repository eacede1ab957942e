/// One sensor with its tables and nothing else: what it costs in flash.
#include "sensor_under_test.hpp"

extern "C" void sensor_step(State& state, const Sample& sample, spoolflow::sensor::Estimate<float>& estimate) {
  estimate = step(parameters, state, sample);
}

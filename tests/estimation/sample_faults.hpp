#pragma once
/// What goes wrong with a sample at 1 kHz.
#include <functional>
#include <limits>
#include <vector>

#include "spoolflow/estimation/timed_sample.hpp"

namespace spoolflow::estimation {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

struct SampleFault {
  const char* name;
  std::function<void(TimedSample&)> happens;  ///< to one sample
};

/// One of each kind that a sensor reports, and each channel as no number.
inline const std::vector<SampleFault> sample_faults = {
    {"current spike", [](TimedSample& s) { s.current_A += 1.5; }},
    {"current spike of the other coil", [](TimedSample& s) { s.current_a_A += 1.5; }},
    {"no current", [](TimedSample& s) { s.current_A = not_measured; }},
    {"no current of the other coil", [](TimedSample& s) { s.current_a_A = infinity; }},
    {"infinite current", [](TimedSample& s) { s.current_A = infinity; }},
    {"no voltage", [](TimedSample& s) { s.voltage_V = not_measured; }},
    {"infinite voltage", [](TimedSample& s) { s.voltage_V = -infinity; }},
    {"no voltage of the other coil", [](TimedSample& s) { s.voltage_a_V = not_measured; }},
    {"no position", [](TimedSample& s) { s.position_m = not_measured; }},
    {"infinite position", [](TimedSample& s) { s.position_m = infinity; }},
    {"no oil temperature", [](TimedSample& s) { s.oil_temperature_K = not_measured; }},
    {"no time", [](TimedSample& s) { s.time_s = not_measured; }},
    {"position jump", [](TimedSample& s) { s.position_m += 0.8e-3; }},
    {"position of the other direction", [](TimedSample& s) { s.position_m -= 1.5e-3; }},
    {"time stands", [](TimedSample& s) { s.time_s -= 1e-3; }},
    {"time runs backwards", [](TimedSample& s) { s.time_s -= 1; }},
    {"leap of time", [](TimedSample& s) { s.time_s += 3600; }},
    {"coil fault", [](TimedSample& s) { s.current_A = 20; }},
    {"coil fault of the other coil", [](TimedSample& s) { s.current_a_A = -20; }},
    {"coil voltage fault", [](TimedSample& s) { s.voltage_V = 400; }},
    {"temperature fault", [](TimedSample& s) { s.oil_temperature_K = 800; }},
};

}  // namespace spoolflow::estimation

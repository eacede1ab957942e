#pragma once

namespace spoolflow::sensor {

/// Whether a stage runs with this sample, and the time since it last ran [s]; the schedule stands in observer.hpp.
template <class T>
struct Due {
  bool now{};
  T since_s{};
};

}  // namespace spoolflow::sensor

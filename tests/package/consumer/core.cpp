/// The sensor's headers from their installed place.
#include <spoolflow/sensor/condensed.hpp>
#include <spoolflow/sensor/observer.hpp>

int main() {
  using namespace spoolflow::sensor;
  static CondensedTables<float> valve{};
  CondensedState<float> state{};
  return has(step(valve, state, Sample<float>{}).status, Status::sample_missing) ? 1 : 0;
}

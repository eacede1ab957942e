#pragma once
/// The paper's condensed sensor of a whole valve: that of the direction into which the spool stands.
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/whole_valve/mirrored.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve_sample.hpp"

namespace spoolflow::sensor {

/// Both directions' tables, which must outlive what refers to them.
template <class T>
struct WholeCondensedTables {
  const CondensedTables<T>* b;  ///< flow P to B
  const CondensedTables<T>* a;  ///< flow P to A
};

/// It remembers only its last answer, in the valve's signs.
template <class T>
struct WholeCondensedState {
  Estimate<T> last{};
};

/// One sample; see the same of one direction. What the idle solenoid holds is left out.
template <class T>
constexpr const Estimate<T>& step(const WholeCondensedTables<T>& valve, WholeCondensedState<T>& state,
                                  const WholeValveSample<T>& sample) {
  const bool opens_a = sample.position_m < T(0);
  CondensedState<T> direction{opens_a ? mirrored(state.last) : state.last};
  const Estimate<T>& answer = step_side<false>(opens_a ? *valve.a : *valve.b, direction, sample_of(sample, opens_a));
  state.last = opens_a ? mirrored(answer) : answer;
  return state.last;
}

}  // namespace spoolflow::sensor

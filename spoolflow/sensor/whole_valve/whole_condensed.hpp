#pragma once
/// The paper's condensed sensor of a whole valve: that of the direction into which the spool stands.
#include "spoolflow/sensor/basis/compiler.hpp"
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

/// Those of the side into which the spool stands.
template <class T>
constexpr const CondensedTables<T>& of_side(const WholeCondensedTables<T>& valve, bool opens_a) {
  return opens_a ? *valve.a : *valve.b;
}

/// It remembers only its last answer, in the valve's signs.
template <class T>
struct WholeCondensedState {
  Estimate<T> last{};
};

/// A sample that cannot be used; see the same of one direction. Without a position the spool may stand on either side.
template <class T>
SPOOLFLOW_NOINLINE constexpr void hold(const WholeCondensedTables<T>& valve, WholeCondensedState<T>& state,
                                       const WholeValveSample<T>& sample) {
  const auto hold_side = [&](bool opens_a) {
    CondensedState<T> direction{mirrored(opens_a, state.last)};
    hold(of_side(valve, opens_a), direction, sample_of(sample, opens_a));
    state.last = mirrored(opens_a, direction.last);
  };
  hold_side(sample.position_m < T(0));
  if (!is_number(sample.position_m)) hold_side(true);
}

/// One sample; see the same of one direction. What the idle solenoid holds is left out.
template <class T>
constexpr const Estimate<T>& step(const WholeCondensedTables<T>& valve, WholeCondensedState<T>& state,
                                  const WholeValveSample<T>& sample) {
  if (unlikely(!is_number(sample.position_m))) {
    hold(valve, state, sample);
    return state.last;
  }
  const bool opens_a = sample.position_m < T(0);
  const auto turned = [&](const Estimate<T>& estimate) {
    if (!opens_a) return estimate;
    return mirrored(opens_a, estimate);
  };
  CondensedState<T> direction{turned(state.last)};
  state.last = turned(step(of_side(valve, opens_a), direction, sample_of(sample, opens_a)));
  return state.last;
}

}  // namespace spoolflow::sensor

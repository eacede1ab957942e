#pragma once
#include "spoolflow/sensor/basis/compiler.hpp"
#include "spoolflow/sensor/basis/due.hpp"
#include "spoolflow/sensor/signals/position_state.hpp"

namespace spoolflow::sensor {

/// When each part of the step runs that the answer can do without for some samples, so that no sample does everything.
/// Beside these every sample runs magnetic force, axial forces, friction, pressure difference and flow rate. A block of
/// positions (position_state.hpp) is 2 ms long; where it is one sample, and until the first closes, all run with every
/// sample.
///
/// | part                           | due with                                               | since it last ran |
/// |--------------------------------|--------------------------------------------------------|-------------------|
/// | friction_memory                | the sample that closes a block                         | a block           |
/// | coil_diagnosis                 | the first after four blocks' time that closes none     | four blocks       |
/// | force_uncertainty, slip_excess | odd samples that close none, and a change of sides     | not needed        |
/// | process_noise, band            | even samples that close none                           | not needed        |
/// | friction_ratio                 | the even ones of the samples that follow a block       | two blocks        |
/// | oil_temperature                | the odd ones of the samples that follow a block        | two blocks        |
template <class T>
struct Schedule {
  Due<T> friction_memory;
  Due<T> coil_diagnosis;
  bool force_uncertainty;
  bool slip_excess;
  bool process_noise;
  bool band;
  Due<T> friction_ratio;
  Due<T> oil_temperature;
};

namespace detail {

template <class T>
SPOOLFLOW_INLINE constexpr Schedule<T> schedule_of(const PositionBlock<T>& block) {
  const bool busy = block.closed && !block.lone;
  const bool odd = block.lone || (!busy && !block.even);
  const bool even = block.lone || (!busy && block.even);
  const T pair = block.lone ? T(1) : T(2);
  Schedule<T> out;
  out.friction_memory = {block.closed, block.length_s, T(1)};
  out.coil_diagnosis = {!busy, block.length_s, T(4)};
  out.force_uncertainty = out.slip_excess = odd;
  out.process_noise = out.band = even;
  out.friction_ratio = {even && block.follows, block.length_s, pair};
  out.oil_temperature = {odd && block.follows, block.length_s, pair};
  return out;
}

}  // namespace detail

}  // namespace spoolflow::sensor

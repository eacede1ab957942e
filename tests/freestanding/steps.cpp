/// The sensor as valve firmware has it: one object file in float, with C entry points, linked against nothing.
#include "all_sensor_headers.hpp"  // written by CMake: every header of spoolflow/sensor

namespace sensor = spoolflow::sensor;

extern "C" void condensed_step(const sensor::CondensedTables<float>* valve, sensor::CondensedState<float>* state,
                               const sensor::Sample<float>* sample, sensor::Estimate<float>* estimate) {
  *estimate = sensor::step(*valve, *state, *sample);
}

extern "C" void observer_step(const sensor::ObserverParameters<float>* valve, sensor::ObserverState<float>* state,
                              const sensor::Sample<float>* sample, sensor::Estimate<float>* estimate) {
  *estimate = sensor::step(*valve, *state, *sample);
}

extern "C" void whole_condensed_step(const sensor::WholeCondensedTables<float>* valve,
                                     sensor::WholeCondensedState<float>* state,
                                     const sensor::WholeValveSample<float>* sample, sensor::Estimate<float>* estimate) {
  *estimate = sensor::step(*valve, *state, *sample);
}

extern "C" void whole_valve_step(const sensor::WholeValveParameters<float>* valve,
                                 sensor::WholeValveState<float>* state, const sensor::WholeValveSample<float>* sample,
                                 sensor::Estimate<float>* estimate) {
  *estimate = sensor::step(*valve, *state, *sample);
}

extern "C" void flow_frames(const sensor::Estimate<float>* estimate, float full_flow_m3_per_s,
                            sensor::CanFrame* j1939_then_canopen) {
  const sensor::FlowAnswer answer = sensor::flow_answer(*estimate, full_flow_m3_per_s);
  j1939_then_canopen[0] = sensor::estimated_flow_frame(answer, {3, 0x80});
  j1939_then_canopen[1] = sensor::process_data_frame(answer, 17);
}

extern "C" unsigned open_image(const void* image, unsigned size, sensor::ValveParameters* valve) {
  return static_cast<unsigned>(sensor::parameters_from(image, size, *valve));
}

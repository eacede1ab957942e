#include "spoolflow/rig/bench/instrument_panel.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::rig {

using recording::Channel;

namespace {

double downstream_Pa(const PlantOutput& plant, bool whole_valve) {
  return plant.path.upstream_pressure_Pa -
         (whole_valve ? plant.path.pressure_difference_Pa : plant.pressure_difference_Pa);
}

double flow_m3_per_s(const PlantOutput& plant, bool whole_valve) {
  return whole_valve ? plant.path.flow_m3_per_s : plant.flow_m3_per_s;
}

bool records(const BenchRun& run, Channel channel) {
  return std::find(run.channels.begin(), run.channels.end(), channel) != run.channels.end();
}

}  // namespace

InstrumentPanel::InstrumentPanel(const Instruments& instruments, std::uint64_t seed, const BenchRun& run,
                                 const PlantOutput& plant, double oil_temperature_C)
    : lvdt(instruments.lvdt, seed, plant.position_m, oil_temperature_C),
      whole_valve_(run.whole_valve),
      driven_coil_(instruments, seed, "", run.machine.pwm, run.machine.spikes),
      load_cell_(instruments.load_cell.errors, seed, "load cell", plant.load_cell_force_N),
      upstream_(instruments.upstream.errors, seed, "upstream pressure", plant.path.upstream_pressure_Pa),
      downstream_(instruments.downstream.errors, seed, "downstream pressure", downstream_Pa(plant, run.whole_valve)),
      thermometer_(instruments.thermometer.errors, seed, "thermometer", oil_temperature_C),
      coil_a_(instruments, seed, " a", run.machine.pwm, run.machine.spikes),
      coil_b_(instruments, seed, " b", run.machine.pwm, run.machine.spikes),
      flow_meter_(instruments.flow_meter, seed, flow_m3_per_s(plant, run.whole_valve)) {
  if (records(run, Channel::pressure_p) || records(run, Channel::pressure_a) || records(run, Channel::pressure_b) ||
      records(run, Channel::pressure_t)) {
    const TransducerErrors sensor = instruments.upstream.errors;
    ports_ = Ports{.P = Transducer(sensor, seed, "pressure P", plant.pressure_P_Pa),
                   .A = Transducer(sensor, seed, "pressure A", plant.pressure_A_Pa),
                   .B = Transducer(sensor, seed, "pressure B", plant.pressure_B_Pa),
                   .T = Transducer(sensor, seed, "pressure T", plant.pressure_T_Pa)};
  }
}

void InstrumentPanel::follow_plant(const PlantOutput& plant, double oil_temperature_C, double dt_s) {
  load_cell_.follow(plant.load_cell_force_N, dt_s);
  upstream_.follow(plant.path.upstream_pressure_Pa, dt_s);
  downstream_.follow(downstream_Pa(plant, whole_valve_), dt_s);
  thermometer_.follow(oil_temperature_C, dt_s);
  flow_meter_.follow(flow_m3_per_s(plant, whole_valve_), dt_s);
  if (ports_) {
    ports_->P.follow(plant.pressure_P_Pa, dt_s);
    ports_->A.follow(plant.pressure_A_Pa, dt_s);
    ports_->B.follow(plant.pressure_B_Pa, dt_s);
    ports_->T.follow(plant.pressure_T_Pa, dt_s);
  }
}

double InstrumentPanel::reading(Channel channel, const SetValues& set) {
  switch (channel) {
    case Channel::time:
      return set.time_s;
    case Channel::current:
      return driven_coil_.current_A();
    case Channel::current_set:
      return set.current_A;
    case Channel::voltage:
      return driven_coil_.voltage_V();
    case Channel::current_a:
      return coil_a_.current_A();
    case Channel::current_b:
      return coil_b_.current_A();
    case Channel::voltage_a:
      return coil_a_.voltage_V();
    case Channel::voltage_b:
      return coil_b_.voltage_V();
    case Channel::position:
      return lvdt.acquired_m(set.time_s);
    case Channel::position_set:
      return set.position;
    case Channel::force:
    case Channel::axial_force:
      return load_cell_.reading();
    case Channel::pressure_upstream:
      return upstream_.reading();
    case Channel::pressure_downstream:
      return downstream_.reading();
    case Channel::pressure_p:
      return ports_->P.reading();
    case Channel::pressure_a:
      return ports_->A.reading();
    case Channel::pressure_b:
      return ports_->B.reading();
    case Channel::pressure_t:
      return ports_->T.reading();
    case Channel::pressure_difference:
      return upstream_.reading() - downstream_.reading();
    case Channel::pressure_difference_set:
      return set.pressure_difference_Pa;
    case Channel::oil_temperature:
      return units::K_from_degC(thermometer_.reading());
    case Channel::flow:
    case Channel::flow_reference:
      return flow_meter_.reading_m3_per_s();
    case Channel::test:
      return set.test;
  }
  return std::nan("");
}

void InstrumentPanel::store(recording::Recording& recording, const std::vector<Channel>& channels,
                            const SetValues& set) {
  // A first sample without a period before it is a single conversion.
  const double conversions = static_cast<double>(std::max<std::int64_t>(1, conversions_));
  driven_coil_.end_period(conversions, set.time_s);
  coil_a_.end_period(conversions, set.time_s);
  coil_b_.end_period(conversions, set.time_s);
  conversions_ = 0;
  for (const Channel channel : channels) {
    recording.column(channel).push_back(reading(channel, set));
  }
}

}  // namespace spoolflow::rig

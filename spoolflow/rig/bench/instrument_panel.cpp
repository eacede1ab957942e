#include "spoolflow/rig/bench/instrument_panel.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::rig {

using recording::Channel;

namespace {

double downstream_Pa(const PlantOutput& plant) {
  return plant.pressure_P_Pa - plant.pressure_difference_Pa;
}

}  // namespace

InstrumentPanel::InstrumentPanel(const Instruments& instruments, std::uint64_t seed, const PlantOutput& plant,
                                 double oil_temperature_C)
    : lvdt(instruments.lvdt, seed, plant.position_m, oil_temperature_C),
      shunt_(errors(instruments.shunt), seed, "shunt", 0),
      voltage_(errors(instruments.voltage), seed, "voltage", 0),
      load_cell_(errors(instruments.load_cell), seed, "load cell", plant.load_cell_force_N),
      upstream_(errors(instruments.upstream), seed, "upstream pressure", plant.pressure_P_Pa),
      downstream_(errors(instruments.downstream), seed, "downstream pressure", downstream_Pa(plant)),
      thermometer_(errors(instruments.thermometer), seed, "thermometer", oil_temperature_C),
      flow_meter_(instruments.flow_meter, seed, plant.flow_m3_per_s) {}

void InstrumentPanel::follow_plant(const PlantOutput& plant, double oil_temperature_C, double dt_s) {
  load_cell_.follow(plant.load_cell_force_N, dt_s);
  upstream_.follow(plant.pressure_P_Pa, dt_s);
  downstream_.follow(downstream_Pa(plant), dt_s);
  thermometer_.follow(oil_temperature_C, dt_s);
  flow_meter_.follow(plant.flow_m3_per_s, dt_s);
}

double InstrumentPanel::reading(Channel channel, const SetValues& set, double noise_share) {
  switch (channel) {
    case Channel::time:
      return set.time_s;
    case Channel::current:
      return shunt_.reading(noise_share);
    case Channel::current_set:
      return set.current_A;
    case Channel::voltage:
      return voltage_.reading(noise_share);
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
    case Channel::current_a:
    case Channel::current_b:
    case Channel::voltage_a:
    case Channel::voltage_b:
    case Channel::pressure_p:
    case Channel::pressure_a:
    case Channel::pressure_b:
    case Channel::pressure_t:
      break;
  }
  return std::nan("");
}

void InstrumentPanel::store(recording::Recording& recording, const std::vector<Channel>& channels,
                            const SetValues& set) {
  // A first sample without a period before it is a single conversion.
  const double conversions = static_cast<double>(std::max<std::int64_t>(1, conversions_));
  shunt_.follow(current_sum_A_ / conversions, 0);
  voltage_.follow(voltage_sum_V_ / conversions, 0);
  current_sum_A_ = voltage_sum_V_ = 0;
  conversions_ = 0;
  for (const Channel channel : channels) {
    recording.column(channel).push_back(reading(channel, set, 1 / std::sqrt(conversions)));
  }
}

}  // namespace spoolflow::rig

#pragma once
/// All instruments of valve and benches with their error figures.
#include "spoolflow/rig/instruments/flow_meter.hpp"
#include "spoolflow/rig/instruments/lvdt.hpp"
#include "spoolflow/rig/instruments/transducer.hpp"

namespace spoolflow::rig {

struct Instruments {
  Lvdt lvdt;
  CurrentShunt shunt;
  VoltageDivider voltage;
  LoadCell load_cell;
  PressureSensor upstream;
  PressureSensor downstream;
  FlowMeter flow_meter;
  Thermometer thermometer;

  template <class Self, class Visit>
  static void describe(Self& self, Visit&& visit) {
    visit("lvdt", self.lvdt);
    visit("shunt", self.shunt);
    visit("voltage", self.voltage);
    visit("load_cell", self.load_cell);
    visit("upstream", self.upstream);
    visit("downstream", self.downstream);
    visit("flow_meter", self.flow_meter);
    visit("thermometer", self.thermometer);
  }
};

}  // namespace spoolflow::rig

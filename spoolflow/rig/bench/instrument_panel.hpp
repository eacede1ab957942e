#pragma once
/// Every instrument of the rig, following one plant and filling one recording.
#include <cstdint>
#include <optional>
#include <vector>

#include "spoolflow/recording/recording.hpp"
#include "spoolflow/rig/bench/bench_run.hpp"
#include "spoolflow/rig/instruments/coil_panel.hpp"
#include "spoolflow/rig/instruments/instruments.hpp"
#include "spoolflow/rig/plant/valve_plant.hpp"

namespace spoolflow::rig {

/// What was commanded at a sample.
struct SetValues {
  double time_s = 0;
  double position = 0;  ///< share of the stroke
  double current_A = 0;
  double pressure_difference_Pa = 0;
  double test = 0;
};

/// Current and mean voltage of both coils.
struct CoilSignals {
  double current_a_A, current_b_A;
  double voltage_a_V, voltage_b_V;
};

class InstrumentPanel {
 public:
  /// What that run records, settled on the plant as it stands; the oil has `oil_temperature_C`.
  InstrumentPanel(const Instruments& instruments, std::uint64_t seed, const BenchRun& run, const PlantOutput& plant,
                  double oil_temperature_C);

  LvdtReading lvdt;

  /// One period of the electronics went by with these mean voltages and these currents at its end. The channels current
  /// and voltage show the driven solenoid; a is negative, as its direction.
  void follow_coils(const CoilSignals& coils) {
    driven_coil_.follow(coils.current_b_A - coils.current_a_A, coils.voltage_b_V - coils.voltage_a_V);
    coil_a_.follow(coils.current_a_A, coils.voltage_a_V);
    coil_b_.follow(coils.current_b_A, coils.voltage_b_V);
    ++conversions_;
  }
  /// The instruments for force, pressures, flow and temperature follow the plant for `dt_s`.
  void follow_plant(const PlantOutput& plant, double oil_temperature_C, double dt_s);
  /// One sample of each of the channels, in SI units; starts new means of current and voltage.
  void store(recording::Recording& recording, const std::vector<recording::Channel>& channels, const SetValues& set);

 private:
  [[nodiscard]] double reading(recording::Channel channel, const SetValues& set);

  struct Ports {
    Transducer P, A, B, T;
  };
  bool whole_valve_;
  CoilPanel driven_coil_;
  Transducer load_cell_, upstream_, downstream_, thermometer_;
  CoilPanel coil_a_, coil_b_;
  std::optional<Ports> ports_;  ///< where the run records them
  FlowMeterReading flow_meter_;
  std::int64_t conversions_ = 0;
};

}  // namespace spoolflow::rig

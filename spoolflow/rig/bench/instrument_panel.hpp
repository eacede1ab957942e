#pragma once
/// Every instrument of the rig, following one plant and filling one recording.
#include <cstdint>
#include <vector>

#include "spoolflow/recording/recording.hpp"
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

class InstrumentPanel {
 public:
  /// Settled on the plant as it stands; the oil has `oil_temperature_C`.
  InstrumentPanel(const Instruments& instruments, std::uint64_t seed, const PlantOutput& plant,
                  double oil_temperature_C);

  LvdtReading lvdt;

  /// One period of the electronics went by with this mean voltage and this current at its end.
  void follow_coil(double current_A, double voltage_V) {
    current_sum_A_ += current_A;
    voltage_sum_V_ += voltage_V;
    ++conversions_;
  }
  /// The instruments for force, pressures, flow and temperature follow the plant for `dt_s`.
  void follow_plant(const PlantOutput& plant, double oil_temperature_C, double dt_s);
  /// One sample of each of the channels, in SI units; starts new means of current and voltage.
  void store(recording::Recording& recording, const std::vector<recording::Channel>& channels, const SetValues& set);

 private:
  [[nodiscard]] double reading(recording::Channel channel, const SetValues& set, double noise_share);

  Transducer shunt_, voltage_, load_cell_, upstream_, downstream_, thermometer_;
  FlowMeterReading flow_meter_;
  double current_sum_A_ = 0;
  double voltage_sum_V_ = 0;
  std::int64_t conversions_ = 0;
};

}  // namespace spoolflow::rig

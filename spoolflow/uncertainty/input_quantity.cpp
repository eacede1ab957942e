#include "spoolflow/uncertainty/input_quantity.hpp"

namespace spoolflow::uncertainty {
namespace {

constexpr double percent = 100;
constexpr std::array<QuantityAbout, quantity_count> descriptions{{
    {"position_zero", "position, zero", "position sensor", "um", 1e6, false},
    {"position_gain", "position, linearity", "position sensor", "%", percent, false},
    {"position_noise", "position, noise", "position sensor", "um", 1e6, false},
    {"current_gain", "current, gain", "current measurement", "%", percent, false},
    {"current_offset", "current, offset", "current measurement", "mA", 1e3, false},
    {"current_noise", "current, noise", "current measurement", "mA", 1e3, false},
    {"voltage_offset", "voltage, offset", "voltage measurement", "mV", 1e3, false},
    {"oil_temperature", "oil temperature", "oil temperature", "K", 1, false},
    {"magnetic_force_map", "force map", "force map", "N", 1, true},
    {"magnetic_load_cell", "load cell of the force map", "force map", "%", percent, true},
    {"magnetic_hysteresis", "magnetic hysteresis", "hysteresis", "%", percent, true},
    {"magnetising_current", "magnetising current", "hysteresis", "mA", 1e3, true},
    {"flow_force_map", "flow-force map", "flow-force map", "N", 1, true},
    {"axial_load_cell", "load cell of the flow-force map", "flow-force map", "%", percent, true},
    {"flow_map", "flow of the map", "flow-force map", "L/min", 60000, true},
    {"flow_meter", "flow meter of the bench", "flow-force map", "%", percent, true},
    {"friction", "friction", "friction", "%", percent, true},
    {"spring", "spring", "spring", "N", 1, true},
    {"oil_density", "oil density", "oil data", "%", percent, false},
    {"oil_viscosity", "oil viscosity", "oil data", "%", percent, false},
    {"pressure_belief", "pressure changes not yet seen", "pressure tracking", "bar", 1e-5, true},
}};

}  // namespace

const QuantityAbout& about(InputQuantity quantity) {
  return descriptions[static_cast<std::size_t>(quantity)];
}

}  // namespace spoolflow::uncertainty

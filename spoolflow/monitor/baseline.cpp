#include "spoolflow/monitor/baseline.hpp"

#include <bit>
#include <span>

namespace spoolflow::monitor {
namespace {

/// FNV-1a over the numbers' bytes.
struct Hash {
  std::uint64_t value = 14695981039346656037ULL;
  void add(double number) {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    for (unsigned shift = 0; shift < 64; shift += 8) {
      value ^= bits >> shift & 0xFFU;
      value *= 1099511628211ULL;
    }
  }
  void add(std::span<const double> numbers) {
    for (const double number : numbers) add(number);
  }
};

void add(Hash& hash, const sensor::ObserverParameters<double>& valve) {
  hash.add(valve.actuator.magnetic_force.map.values);
  hash.add(valve.actuator.coil.flux_linkage.map.values);
  hash.add(valve.actuator.coil_resistance.resistance_Ohm);
  hash.add(valve.actuator.friction_N.values);
  hash.add(valve.spring.curve.values);
  hash.add(valve.edge.flow_force_N.values);
  hash.add(valve.edge.friction_N.values);
  hash.add(valve.edge.conductance.values);
  hash.add(valve.position_sensor.drift_m_per_K);
  hash.add(valve.friction.operation_ratio);
  hash.add(valve.closed_below_m);
}

}  // namespace

std::uint64_t fingerprint(const model::Model& model) {
  Hash hash;
  if (model.observer) add(hash, model.observer->parameters);
  if (model.p_to_a && model.p_to_a->observer) add(hash, model.p_to_a->observer->parameters);
  return hash.value;
}

}  // namespace spoolflow::monitor

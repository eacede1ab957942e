#include "spoolflow/export/cpp/c_header.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "spoolflow/export/cpp/exported_text.hpp"
#include "spoolflow/sensor/machine_reference.hpp"
#include "spoolflow/sensor/whole_valve/whole_condensed.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"

namespace spoolflow::exports {
namespace {

/// States hold numbers, words and bools, no addresses: they are as large here as on the target, which holds it.
std::size_t state_bytes(bool whole, bool observer) {
  if (whole) return observer ? sizeof(sensor::WholeValveState<float>) : sizeof(sensor::WholeCondensedState<float>);
  return observer ? sizeof(sensor::ObserverState<float>) : sizeof(sensor::CondensedState<float>);
}

constexpr std::size_t references_bytes = sizeof(sensor::MachineKnowledge<float>) +
                                         sizeof(sensor::ReferenceState<float>) + sizeof(sensor::PassedVolume<float>);

std::string status_bits() {
  std::string out;
  for (const sensor::StatusName& entry : sensor::status_names) {
    std::string name;
    for (const char* letter = entry.name; *letter != '\0'; ++letter)
      name += *letter >= 'a' && *letter <= 'z' ? static_cast<char>(*letter - 'a' + 'A') : *letter;
    out +=
        fmt::format("#define VALVE_SENSOR_STATUS_{} UINT32_C(0x{:X})\n", name, static_cast<std::uint32_t>(entry.bit));
  }
  return out;
}

}  // namespace

std::string c_header(const model::Model& model) {
  const bool observer = model.has_observer();
  return exported_text("valve_sensor.h.in", {{"@VALVE@", in_a_block_comment(model.valve.name)},
                                             {"@WHOLE@", model.whole() ? "1" : "0"},
                                             {"@OBSERVER@", observer ? "1" : "0"},
                                             {"@STATUS@", status_bits()},
                                             {"@FAULTS@", fmt::format("{:X}", sensor::fault_bits)},
                                             {"@STATE_BYTES@", fmt::format("{}", state_bytes(model.whole(), observer))},
                                             {"@REFERENCES_BYTES@", fmt::format("{}", references_bytes)}});
}

}  // namespace spoolflow::exports

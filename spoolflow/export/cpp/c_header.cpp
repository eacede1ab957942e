#include "spoolflow/export/cpp/c_header.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "spoolflow/sensor/whole_valve/whole_condensed.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"

namespace spoolflow::exports {
namespace {

/// States hold numbers, words and bools, no addresses: they are as large here as on the target, which holds it.
std::size_t state_bytes(bool whole, bool observer) {
  if (whole) return observer ? sizeof(sensor::WholeValveState<float>) : sizeof(sensor::WholeCondensedState<float>);
  return observer ? sizeof(sensor::ObserverState<float>) : sizeof(sensor::CondensedState<float>);
}

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

/// As it may stand in a comment of C: nothing in it ends the comment or its line.
std::string in_a_c_comment(const std::string& name) {
  std::string out;
  for (const char letter : name)
    out += static_cast<unsigned char>(letter) < ' ' || letter == '*' || letter == '\\' || letter == '?' ? ' ' : letter;
  return out;
}

}  // namespace

std::string c_header(std::string text, const model::Model& model) {
  const bool observer = model.has_observer();
  const auto put = [&text](const std::string& place, const std::string& content) {
    text.replace(text.find(place), place.size(), content);
  };
  put("@VALVE@", in_a_c_comment(model.valve.name));
  put("@WHOLE@", model.whole() ? "1" : "0");
  put("@OBSERVER@", observer ? "1" : "0");
  put("@STATUS@", status_bits());
  put("@FAULTS@", fmt::format("{:X}", sensor::fault_bits));
  put("@STATE_BYTES@", fmt::format("{}", state_bytes(model.whole(), observer)));
  return text;
}

}  // namespace spoolflow::exports

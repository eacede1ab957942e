/// Commands to a Sparkplug node (NCMD): any bytes as a payload, and payloads of our own with the input's bytes in them,
/// of which each is known whether it asks for a new birth.
#include "addons/live/protocols/sparkplug.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spoolflow;
  const std::string input(reinterpret_cast<const char*>(data), size);
  (void)fieldbus::asks_for_rebirth(input);
  if (size < 2) return 0;
  const bool value = (data[0] & 1U) != 0;
  const std::string text = input.substr(1);
  fieldbus::SparkplugPayload payload{.time_ms = data[1], .seq = data[0]};
  payload.metrics.push_back({.name = text, .time_ms = data[1], .value = value});
  const bool named = text == "Node Control/Rebirth";
  fuzz::require(fieldbus::asks_for_rebirth(fieldbus::sparkplug_bytes(payload)) == (named && value));
  payload.metrics.push_back({.name = "other", .time_ms = 0, .value = text});
  payload.metrics.push_back({.name = "Node Control/Rebirth", .time_ms = 0, .value = true});
  const std::string asking = fieldbus::sparkplug_bytes(payload);
  fuzz::require(fieldbus::asks_for_rebirth(asking));
  (void)fieldbus::asks_for_rebirth(asking.substr(0, data[1] % asking.size()));
  return 0;
}

#pragma once
/// All of a site that goes out to fieldbus and plant, and samples by MQTT, as its file switches it on.
#include <optional>
#include <string>
#include <vector>

#include "addons/live/fieldbus/can_sender.hpp"
#include "addons/live/fieldbus/modbus_server.hpp"
#include "addons/live/fieldbus/mqtt_receiver.hpp"
#include "addons/live/fieldbus/mqtt_sender.hpp"

namespace spoolflow::live {

/// Throws SiteError where the site asks for what this build has not.
void check_built_in(const SiteSettings& site);

/// At work until it is destroyed. The engine must have been started and outlive it.
class FieldbusOutputs {
 public:
  /// Throws SiteError where an address or a port cannot be had.
  explicit FieldbusOutputs(Engine& engine);
  /// Where each of them is, in words.
  [[nodiscard]] const std::vector<std::string>& where() const { return where_; }

 private:
  std::optional<CanSender> can_;
  std::optional<ModbusServer> modbus_;
  std::optional<MqttSender> mqtt_;
  std::optional<MqttReceiver> receiver_;
  std::vector<std::string> where_;
};

}  // namespace spoolflow::live

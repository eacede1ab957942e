#pragma once
/// MQTT with Sparkplug B: the site as an edge node, each valve a device. Topics and metrics: docs/fieldbus.md.
#include <memory>

#include "addons/live/engine.hpp"

namespace spoolflow::live {

/// Whether this build has it.
[[nodiscard]] bool has_mqtt();

/// Sends from threads of its own until it is destroyed, and keeps what cannot be sent. The engine must outlive it.
class MqttSender {
 public:
  /// Throws SiteError where the password's file cannot be read, or has_mqtt() is false. The broker need not be there.
  MqttSender(Engine& engine, const MqttSettings& settings);
  ~MqttSender();
  MqttSender(const MqttSender&) = delete;
  MqttSender& operator=(const MqttSender&) = delete;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace spoolflow::live

#pragma once
/// Samples by MQTT: subscribes to the topics of the site's valves and hands on what comes. Format: docs/live.md.
#include <memory>

#include "addons/live/engine.hpp"

namespace spoolflow::live {

/// Receives in threads of its own until it is destroyed, and connects again and again while the broker is away. The
/// engine must have been started and outlive it.
class MqttReceiver {
 public:
  /// Throws SiteError where the password's file cannot be read, or has_mqtt() is false. The broker need not be there.
  MqttReceiver(Engine& engine, const MqttSourceSettings& settings);
  ~MqttReceiver();
  MqttReceiver(const MqttReceiver&) = delete;
  MqttReceiver& operator=(const MqttReceiver&) = delete;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace spoolflow::live

#pragma once
/// What both directions of MQTT share: a connection to a broker, by Paho C.
#include <MQTTClient.h>
#include <string>

#include "addons/live/fieldbus_settings.hpp"

namespace spoolflow::live {

/// Paho's words for its code.
[[nodiscard]] std::string mqtt_words(int code);

/// A client of that broker; `table` stands in messages. Not connected yet.
class MqttClient {
 public:
  /// Throws SiteError where the password's file cannot be read, or the address is none.
  MqttClient(const BrokerSettings& broker, const std::string& id, const std::string& table);
  ~MqttClient() { MQTTClient_destroy(&client_); }
  MqttClient(const MqttClient&) = delete;
  MqttClient& operator=(const MqttClient&) = delete;

  [[nodiscard]] MQTTClient get() const { return client_; }
  /// A session without memory; `will` may be null. Returns Paho's code.
  [[nodiscard]] int connect(MQTTClient_willOptions* will) const;
  /// What is wrong where there is no connection.
  [[nodiscard]] std::string no_connection(int code) const;

 private:
  BrokerSettings broker_;
  std::string password_;
  MQTTClient client_ = nullptr;
};

}  // namespace spoolflow::live

/// In place of mqtt_sender.cpp and mqtt_receiver.cpp where Paho C was not there.
#include "addons/live/fieldbus/mqtt_receiver.hpp"
#include "addons/live/fieldbus/mqtt_sender.hpp"

namespace spoolflow::live {

struct MqttSender::Parts {};

bool has_mqtt() {
  return false;
}

MqttSender::MqttSender(Engine&, const MqttSettings&) {
  throw SiteError("[mqtt]: this spoolflow was built without MQTT");
}
MqttSender::~MqttSender() = default;

struct MqttReceiver::Parts {};

MqttReceiver::MqttReceiver(Engine&, const MqttSourceSettings&) {
  throw SiteError("[sources.mqtt]: this spoolflow was built without MQTT");
}
MqttReceiver::~MqttReceiver() = default;

}  // namespace spoolflow::live

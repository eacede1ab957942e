/// In place of mqtt_sender.cpp where Paho C was not there.
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

}  // namespace spoolflow::live

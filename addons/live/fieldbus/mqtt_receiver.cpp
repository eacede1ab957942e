#include "addons/live/fieldbus/mqtt_receiver.hpp"

#include <atomic>
#include <random>
#include <thread>

#include <fmt/format.h>

#include "addons/live/fieldbus/mqtt_login.hpp"
#include "spoolflow/parallel/pace.hpp"

namespace spoolflow::live {
namespace {

/// Two clients of one name would put each other out.
std::string client_id() {
  std::random_device random;
  return fmt::format("spoolflow-{:08x}{:08x}", random(), random());
}

}  // namespace

struct MqttReceiver::Parts {
  MessageSources& messages;
  MqttClient client;
  std::atomic<bool> is_connected{false};
  std::jthread keeper{};

  Parts(Engine& engine, const MqttSourceSettings& settings)
      : messages(*engine.messages()), client(settings.broker, client_id(), "[sources.mqtt]") {
    (void)MQTTClient_setCallbacks(client.get(), this, &lost, &arrived, nullptr);
  }
  ~Parts() {
    keeper = {};
    if (is_connected) (void)MQTTClient_disconnect(client.get(), 500);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  static void lost(void* context, char*) { static_cast<Parts*>(context)->is_connected = false; }
  static int arrived(void* context, char* topic, int length, MQTTClient_message* message) {
    // What the broker kept for those that come later is of another time.
    if (message->retained == 0) {
      const std::string name = length > 0 ? std::string(topic, static_cast<std::size_t>(length)) : std::string(topic);
      static_cast<Parts*>(context)->messages.take(
          name, {static_cast<const char*>(message->payload), static_cast<std::size_t>(message->payloadlen)});
    }
    MQTTClient_freeMessage(&message);
    MQTTClient_free(topic);
    return 1;
  }

  /// What is wrong; empty: it hears.
  std::string connect() {
    if (const int done = client.connect(nullptr); done != MQTTCLIENT_SUCCESS) return client.no_connection(done);
    for (const std::string& topic : messages.topics()) {
      if (const int done = MQTTClient_subscribe(client.get(), topic.c_str(), 1); done != MQTTCLIENT_SUCCESS)
        return fmt::format("the broker gives no {}: {}", topic, mqtt_words(done));
    }
    is_connected = true;
    return {};
  }
  void keep(const std::stop_token& stop) {
    constexpr std::chrono::milliseconds between_tries(1000), between_looks(50);
    while (!stop.stop_requested()) {
      const bool hears = is_connected;
      if (!hears) {
        const std::string trouble = connect();
        messages.set_connected(trouble.empty(), trouble);
      }
      (void)parallel::wait_for(is_connected ? between_looks : between_tries, stop);
    }
  }
};

MqttReceiver::MqttReceiver(Engine& engine, const MqttSourceSettings& settings)
    : parts_(std::make_unique<Parts>(engine, settings)) {
  parts_->keeper = std::jthread([parts = parts_.get()](const std::stop_token& stop) { parts->keep(stop); });
}

MqttReceiver::~MqttReceiver() = default;

}  // namespace spoolflow::live

#include "addons/live/fieldbus/mqtt_login.hpp"

#include <fstream>

#include <fmt/format.h>

namespace spoolflow::live {
namespace {

std::string first_line(const std::filesystem::path& file, const std::string& table) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line) || line.empty()) {
    throw SiteError(fmt::format("{}: {} holds no password in its first line, or cannot be read", table, file.string()));
  }
  return line;
}

}  // namespace

std::string mqtt_words(int code) {
  const char* const text = MQTTClient_strerror(code);
  return text == nullptr ? fmt::format("code {}", code) : text;
}

MqttClient::MqttClient(const BrokerSettings& broker, const std::string& id, const std::string& table)
    : broker_(broker), password_(broker.user.empty() ? "" : first_line(broker.password_file, table)) {
  const int made =
      MQTTClient_create(&client_, broker_.address.c_str(), id.c_str(), MQTTCLIENT_PERSISTENCE_NONE, nullptr);
  if (made == MQTTCLIENT_SUCCESS) return;
  throw SiteError(fmt::format("{}: '{}' is no broker's address ({}); write tcp://HOST:1883", table, broker_.address,
                              mqtt_words(made)));
}

int MqttClient::connect(MQTTClient_willOptions* will) const {
  MQTTClient_SSLOptions tls = MQTTClient_SSLOptions_initializer;
  const std::string authority = broker_.authority.string();
  if (!authority.empty()) tls.trustStore = authority.c_str();
  tls.verify = 1;
  tls.sslVersion = MQTT_SSL_VERSION_TLS_1_2;
  MQTTClient_connectOptions options = MQTTClient_connectOptions_initializer;
  options.keepAliveInterval = 10;
  options.cleansession = 1;
  options.connectTimeout = 3;
  options.MQTTVersion = MQTTVERSION_3_1_1;
  options.will = will;
  if (broker_.address.starts_with("ssl://")) options.ssl = &tls;
  if (!broker_.user.empty()) {
    options.username = broker_.user.c_str();
    options.password = password_.c_str();
  }
  if (MQTTClient_isConnected(client_) != 0) (void)MQTTClient_disconnect(client_, 0);
  return MQTTClient_connect(client_, &options);
}

std::string MqttClient::no_connection(int code) const {
  return fmt::format("no connection to {}: {}", broker_.address, mqtt_words(code));
}

}  // namespace spoolflow::live

#pragma once
/// [can], [modbus] and [mqtt] of a site's file: what goes out to fieldbus and plant (docs/fieldbus.md); and
/// [sources.mqtt]: what comes from there (docs/live.md).
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "addons/live/sources/socket.hpp"

namespace spoolflow::recording {
struct TomlTable;
}

namespace spoolflow::live {

/// Where frames go, any of them at once, and which valves send what.
struct CanSettings {
  std::string interface {};                               ///< of SocketCAN, such as "can0"; empty: none
  std::filesystem::path log{};                            ///< candump's (.log) or Vector's (.asc); empty: none
  double log_largest_MB = 100;                            ///< then it is renamed to FILE.1 and begun again
  std::optional<Address> udp{};                           ///< multicast group of python-can's udp_multicast
  std::string udp_through = "127.0.0.1";                  ///< address of the network interface that its datagrams take
  std::uint8_t source_address = 0x80;                     ///< of J1939, 0 to 253
  std::uint16_t period_ms = 100;                          ///< of CiA 408's process data, 10 to 10000
  std::map<std::string, std::uint8_t> auxiliary_valve{};  ///< valve's id, n of PGN 65040 + n
  std::map<std::string, std::uint8_t> node{};             ///< valve's id, CANopen node
};
/// Modbus TCP, read-only.
struct ModbusSettings {
  Address listen{"127.0.0.1", 502};
  std::vector<std::string> allow{};  ///< who may ask, where other machines reach the address
  unsigned unit = 1;                 ///< whom it answers as; 0 and 255 are answered, too
};
/// A broker of MQTT 3.1.1 and who is at it.
struct BrokerSettings {
  std::string address{};                  ///< "tcp://HOST:PORT" or "ssl://HOST:PORT"
  std::string user{};                     ///< empty: none
  std::filesystem::path password_file{};  ///< whose first line is the user's password
  std::filesystem::path authority{};      ///< PEM of who signed the broker's certificate, of ssl
};
/// What goes out with Sparkplug B 3.0.
struct MqttSettings {
  BrokerSettings broker{};
  std::string group{}, edge_node{};  ///< of Sparkplug's topics: no '/', '+' or '#'
  double period_s = 1;               ///< of DDATA, 0.1 to 3600
  double keep_s = 3600;              ///< what is kept while the broker is away: the newest so long
};
/// Where samples come from.
struct MqttSourceSettings {
  BrokerSettings broker{};
  std::string topic{};  ///< "hall_3/+/samples": one level '+' is the valve's id; empty: each valve names its own
};
/// What stands in the place of '+' where the topic fits; nothing where it does not.
[[nodiscard]] std::optional<std::string> id_in_topic(const std::string& pattern, const std::string& topic);

/// Throw SiteError or RecordingError with file, line and remedy.
[[nodiscard]] CanSettings read_can(const recording::TomlTable& can);
[[nodiscard]] ModbusSettings read_modbus(const recording::TomlTable& modbus);
[[nodiscard]] MqttSettings read_mqtt(const recording::TomlTable& mqtt);
[[nodiscard]] MqttSourceSettings read_mqtt_source(const recording::TomlTable& mqtt);
/// Throws SiteError where a valve is named that the site has not.
void check_valves(const CanSettings& can, const std::vector<std::string>& ids, const std::filesystem::path& file);

}  // namespace spoolflow::live

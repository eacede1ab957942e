#include "addons/live/fieldbus_settings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "spoolflow/recording/channels/allowed_names.hpp"
#include "spoolflow/recording/toml_input.hpp"

namespace spoolflow::live {
namespace {

using recording::TomlTable;

struct Range {
  double least, most;
};

double within(const TomlTable& table, std::string_view key, double otherwise, Range range) {
  const double value = table.optional_number(key).value_or(otherwise);
  if (value >= range.least && value <= range.most) return value;
  throw SiteError(
      fmt::format("{}: {} is {}; allowed: {} to {}", table.place(key), key, value, range.least, range.most));
}

int whole_within(const TomlTable& table, std::string_view key, int otherwise, Range range) {
  const double value = within(table, key, otherwise, range);
  if (value == static_cast<int>(value)) return static_cast<int>(value);
  throw SiteError(fmt::format("{}: {} is {}; it must be a whole number", table.place(key), key, value));
}

/// { press_1 = 0, press_2 = 1 }: no number twice.
std::map<std::string, std::uint8_t> numbers_of_valves(const TomlTable& table, const char* key, Range range) {
  std::map<std::string, std::uint8_t> out;
  const toml::node* node = table.table.get(key);
  if (node == nullptr) return out;
  const toml::table* const valves = node->as_table();
  if (valves == nullptr) {
    throw SiteError(fmt::format("{}: {} gives each valve its number, such as {{ press_1 = {} }}", table.place(key), key,
                                range.least));
  }
  const TomlTable its{*valves, table.file, fmt::format("{} of {}", key, table.name)};
  for (const auto& [id, value] : *valves) {
    const auto number = static_cast<std::uint8_t>(whole_within(its, id.str(), -1, range));
    const auto same = std::find_if(out.begin(), out.end(), [&](const auto& one) { return one.second == number; });
    if (same != out.end()) {
      throw SiteError(fmt::format("{}: '{}' and '{}' have the number {} both; give one another", its.place(id.str()),
                                  same->first, id.str(), number));
    }
    out[std::string(id.str())] = number;
  }
  return out;
}

std::filesystem::path file_of(const TomlTable& table, const char* key) {
  const auto name = table.optional_text(key);
  return name ? table.file.parent_path() / *name : std::filesystem::path();
}

std::vector<std::string> who_may_ask(const TomlTable& table) {
  if (!table.table.contains("allow")) return {};
  auto out = table.list_of_texts("allow");
  if (!out) {
    throw SiteError(
        fmt::format("{}: 'allow' must be a list of addresses, such as [\"192.168.0.7\"]", table.place("allow")));
  }
  for (std::string& host : *out) host = read_host(host, table.place("allow"));
  return std::move(*out);
}

std::string topic_part(const TomlTable& table, const char* key) {
  std::string text = table.text(key);
  if (!text.empty() && text.size() <= 64 && text.find_first_of("/+#") == std::string::npos) return text;
  throw SiteError(
      fmt::format("{}: {} is '{}'; it must be 1 to 64 letters without '/', '+' and '#'", table.place(key), key, text));
}

BrokerSettings read_broker(const TomlTable& mqtt) {
  BrokerSettings out{.address = mqtt.text("broker"),
                     .user = mqtt.optional_text("user").value_or(""),
                     .password_file = file_of(mqtt, "password_file"),
                     .authority = file_of(mqtt, "authority")};
  const bool is_encrypted = out.address.starts_with("ssl://");
  if (!is_encrypted && !out.address.starts_with("tcp://")) {
    throw SiteError(fmt::format("{}: broker is '{}'; write tcp://HOST:1883, or ssl://HOST:8883 with TLS",
                                mqtt.place("broker"), out.address));
  }
  if (out.user.empty() != out.password_file.empty()) {
    throw SiteError(fmt::format("{}: user and password_file go together; name the other, too",
                                mqtt.place(out.user.empty() ? "password_file" : "user")));
  }
  const std::string host = out.address.substr(6, out.address.rfind(':') - 6);
  const bool is_here = host == "localhost" || Address{host, 0}.is_loopback();
  if (!out.user.empty() && !is_encrypted && !is_here) {
    throw SiteError(
        fmt::format("{}: a password would go to '{}' unencrypted; write ssl://HOST:8883, with authority = "
                    "\"ca.pem\"",
                    mqtt.place("broker"), out.address));
  }
  return out;
}

}  // namespace

CanSettings read_can(const TomlTable& can) {
  can.allow_only({"interface", "log", "log_largest_MB", "udp", "udp_through", "source_address", "period_ms",
                  "auxiliary_valve", "node"});
  CanSettings out{.interface = can.optional_text("interface").value_or(""), .log = file_of(can, "log")};
  const std::string suffix = out.log.extension().string();
  if (!out.log.empty() && suffix != ".log" && suffix != ".asc") {
    throw SiteError(
        fmt::format("{}: log is '{}'; a name that ends with .log is written as candump does, one with .asc "
                    "as Vector's tools do",
                    can.place("log"), out.log.string()));
  }
  out.log_largest_MB = can.optional_positive("log_largest_MB").value_or(out.log_largest_MB);
  if (const auto udp = can.optional_text("udp")) out.udp = read_address(*udp, can.place("udp"));
  if (const auto through = can.optional_text("udp_through")) {
    out.udp_through = read_address(*through + ":0", can.place("udp_through")).host;
  }
  if (out.interface.empty() && out.log.empty() && !out.udp) {
    throw SiteError(
        fmt::format("{}: [can] names nothing that frames could go to; write interface = \"can0\", log = "
                    "\"bus.log\" or udp = \"239.74.163.2:43113\"",
                    recording::place_of(can.table, can.file)));
  }
  out.source_address = static_cast<std::uint8_t>(whole_within(can, "source_address", out.source_address, {0, 253}));
  out.period_ms = static_cast<std::uint16_t>(whole_within(can, "period_ms", out.period_ms, {10, 10000}));
  out.auxiliary_valve = numbers_of_valves(can, "auxiliary_valve", {0, 15});
  out.node = numbers_of_valves(can, "node", {1, 127});
  if (out.auxiliary_valve.empty() && out.node.empty()) {
    throw SiteError(
        fmt::format("{}: [can] names no valve; write auxiliary_valve = {{ press_1 = 0 }} for J1939 or node = "
                    "{{ press_1 = 17 }} for CANopen",
                    recording::place_of(can.table, can.file)));
  }
  return out;
}

void check_valves(const CanSettings& can, const std::vector<std::string>& ids, const std::filesystem::path& file) {
  for (const auto* of : {&can.auxiliary_valve, &can.node}) {
    for (const auto& [id, number] : *of) {
      if (std::find(ids.begin(), ids.end(), id) != ids.end()) continue;
      throw SiteError(
          fmt::format("{}: [can] gives '{}' the number {}, and the site has no such valve{}; its valves: {}",
                      file.string(), id, number, recording::did_you_mean(id, ids), recording::listed(ids)));
    }
  }
}

ModbusSettings read_modbus(const TomlTable& modbus) {
  modbus.allow_only({"listen", "allow", "unit"});
  ModbusSettings out;
  if (const auto listen = modbus.optional_text("listen")) out.listen = read_address(*listen, modbus.place("listen"));
  out.allow = who_may_ask(modbus);
  out.unit = static_cast<unsigned>(whole_within(modbus, "unit", 1, {1, 247}));
  if (!out.listen.is_loopback() && out.allow.empty()) {
    throw SiteError(
        fmt::format("{}: [modbus] listens at {}, which other machines reach, and Modbus knows no passwords; "
                    "list who may ask as allow = [\"192.168.0.7\"]",
                    modbus.place("listen"), out.listen.text()));
  }
  return out;
}

std::optional<std::string> id_in_topic(const std::string& pattern, const std::string& topic) {
  const std::size_t plus = pattern.find('+');
  if (plus == std::string::npos) return {};
  const std::string_view before = std::string_view(pattern).substr(0, plus),
                         behind = std::string_view(pattern).substr(plus + 1);
  if (topic.size() <= before.size() + behind.size() || !topic.starts_with(before) || !topic.ends_with(behind))
    return {};
  std::string id = topic.substr(before.size(), topic.size() - before.size() - behind.size());
  if (id.find('/') != std::string::npos) return {};
  return id;
}

MqttSettings read_mqtt(const TomlTable& mqtt) {
  mqtt.allow_only({"broker", "group", "edge_node", "user", "password_file", "authority", "period_s", "keep_s"});
  MqttSettings out{
      .broker = read_broker(mqtt), .group = topic_part(mqtt, "group"), .edge_node = topic_part(mqtt, "edge_node")};
  out.period_s = within(mqtt, "period_s", out.period_s, {0.1, 3600});
  out.keep_s = within(mqtt, "keep_s", out.keep_s, {0, 86400});
  return out;
}

MqttSourceSettings read_mqtt_source(const TomlTable& mqtt) {
  mqtt.allow_only({"broker", "topic", "user", "password_file", "authority"});
  MqttSourceSettings out{read_broker(mqtt), mqtt.optional_text("topic").value_or("")};
  if (out.topic.empty()) return out;
  const std::size_t plus = out.topic.find('+');
  const bool is_level = plus != std::string::npos && (plus == 0 || out.topic[plus - 1] == '/') &&
                        (plus + 1 == out.topic.size() || out.topic[plus + 1] == '/');
  if (is_level && out.topic.rfind('+') == plus && out.topic.find('#') == std::string::npos) return out;
  throw SiteError(fmt::format(
      "{}: topic is '{}'; one level of it is '+', in whose place the valve's id stands, such as hall_3/+/samples",
      mqtt.place("topic"), out.topic));
}

}  // namespace spoolflow::live

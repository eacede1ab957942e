#pragma once
/// A site as its file describes it: valves with their models and sources. Format: docs/live.md.
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "addons/live/fieldbus_settings.hpp"
#include "addons/live/history/store.hpp"
#include "addons/live/notify_settings.hpp"
#include "addons/live/page_settings.hpp"
#include "addons/live/publish_settings.hpp"
#include "addons/live/sources/replay_source.hpp"
#include "addons/live/sources/rig_source.hpp"
#include "addons/live/sources/socket.hpp"
#include "addons/live/valve/alarms.hpp"
#include "addons/live/valve/valve_at_work.hpp"
#include "spoolflow/recording/channel_map.hpp"

namespace spoolflow::live {

struct UdpSettings {};
struct TcpSettings {
  Address listen;
};
struct MqttTopicSettings {
  std::string topic;  ///< as it is subscribed to, the valve's own or that of [sources.mqtt] with its id
};
struct PipeSettings {
  std::filesystem::path path;  ///< "-": standard input
};
using SourceSettings =
    std::variant<UdpSettings, TcpSettings, MqttTopicSettings, PipeSettings, ReplaySettings, RigSettings>;
/// "udp", "tcp", "mqtt", "pipe", "replay" or "rig".
[[nodiscard]] std::string_view kind(const SourceSettings& source);

struct ValveSettings {
  std::string id;
  SharedModel model;
  SourceSettings source;
  recording::ChannelMap channels{};  ///< of CSV and replay; empty: headers follow <channel>_<unit>
};

struct SiteSettings {
  std::vector<ValveSettings> valves{};
  PageSettings page{};
  PublishSettings fleet{};
  std::optional<Address> udp{};                     ///< of all valves whose source is udp
  std::optional<MqttSourceSettings> mqtt_source{};  ///< of all valves whose source is mqtt
  std::vector<std::string> allow{};  ///< addresses that may send samples; empty: any that can reach a loopback address
  double stalled_after_s = 1.0;      ///< without a sample
  std::string store{};               ///< file; empty: nothing is kept
  Retention retention{};
  /// Raw samples around an alarm that are kept as a recording, where there is a store.
  double raw_before_s = 20, raw_after_s = 10;
  AlarmDelays alarms{};
  std::vector<NotifySettings> notify{};  ///< who gets messages of alarms
  std::optional<Address> plotjuggler{};  ///< where plots go as JSON over UDP; nothing: nowhere
  std::optional<CanSettings> can{};      ///< what goes to fieldbus and plant; nothing: off
  std::optional<ModbusSettings> modbus{};
  std::optional<MqttSettings> mqtt{};
};

/// Reads the file, the models and valve files that it names. Throws RecordingError, SiteError, ModelError or
/// SettingsError with file, line, value and remedy.
[[nodiscard]] SiteSettings read_site(const std::filesystem::path& file);

/// The embedded default: eight valves of the virtual rig with one model, three of which age fast.
[[nodiscard]] SiteSettings demo_site();

}  // namespace spoolflow::live

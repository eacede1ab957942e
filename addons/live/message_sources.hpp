#pragma once
/// The valves of a site whose samples come as messages of a broker, each by its topic. What carries the messages is no
/// part of it (fieldbus/mqtt_receiver.hpp).
#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "addons/live/fieldbus_settings.hpp"
#include "addons/live/sources/message_source.hpp"
#include "addons/live/sources/unknown_senders.hpp"

namespace spoolflow::live {

struct MessageCounters {
  std::uint64_t messages = 0;
  std::uint64_t unknown_valve = 0;  ///< of a topic that is no valve's
  bool connected = false;           ///< to the broker, at present
};

class MessageSources {
 public:
  explicit MessageSources(const MqttSourceSettings& settings) : settings_(settings) {}

  /// Before the first message.
  void add(const std::string& topic, recording::ReadOptions channels, const SourcePosition& after, Intake& intake);
  /// What to subscribe to.
  [[nodiscard]] std::vector<std::string> topics() const;
  /// From one thread.
  void take(const std::string& topic, std::string_view payload);
  /// From one thread. Why no messages come; empty: they may.
  void set_connected(bool connected, const std::string& trouble);
  void ask_to_stop();

  [[nodiscard]] MessageCounters counters() const { return {messages_, unknown_valve_, connected_}; }
  [[nodiscard]] std::vector<UnknownSender> unknown_senders() const { return unknown_.all(); }

 private:
  const MqttSourceSettings& settings_;
  std::map<std::string, std::unique_ptr<MessageSource>, std::less<>> sources_{};
  std::atomic<std::uint64_t> messages_ = 0, unknown_valve_ = 0;
  std::atomic<bool> connected_ = false;
  UnknownSenders unknown_{};
};

}  // namespace spoolflow::live

#include "addons/live/fieldbus/mqtt_sender.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "addons/live/fieldbus/mqtt_login.hpp"
#include "addons/live/fieldbus/plant_answers.hpp"
#include "addons/live/protocols/sparkplug.hpp"
#include "spoolflow/parallel/pace.hpp"

namespace spoolflow::live {
namespace {

using fieldbus::PlantAnswer;
using fieldbus::SparkplugMetric;

/// All valves at one time.
struct Record {
  std::int64_t time_ms = 0;
  std::vector<PlantAnswer> valves{};
};

/// What waits for the broker: the newest records, oldest first.
class Waiting {
 public:
  explicit Waiting(std::size_t most) : most_(most) {}
  /// How many were given up for it.
  std::size_t add(Record record) {
    const std::lock_guard lock(mutex_);
    records_.push_back(std::move(record));
    if (records_.size() <= most_) return 0;
    records_.pop_front();
    ++first_;
    return 1;
  }
  /// The oldest with its number; nothing where there is none.
  std::optional<std::pair<std::uint64_t, Record>> oldest() const {
    const std::lock_guard lock(mutex_);
    if (records_.empty()) return std::nullopt;
    return std::pair(first_, records_.front());
  }
  void remove(std::uint64_t number) {
    const std::lock_guard lock(mutex_);
    if (records_.empty() || first_ != number) return;  // it was given up meanwhile
    records_.pop_front();
    ++first_;
  }
  [[nodiscard]] std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return records_.size();
  }

 private:
  std::size_t most_;
  mutable std::mutex mutex_;
  std::deque<Record> records_{};
  std::uint64_t first_ = 0;
};

std::size_t most_records(const MqttSettings& settings, std::size_t valves) {
  constexpr double most_answers = 200000;  // about 40 MB
  const double wanted = settings.keep_s / settings.period_s;
  return static_cast<std::size_t>(std::max(1.0, std::min(wanted, most_answers / static_cast<double>(valves))));
}

}  // namespace

bool has_mqtt() {
  return true;
}

struct MqttSender::Parts {
  Engine& engine;
  MqttSettings settings;
  MqttClient client;
  std::shared_ptr<Output> output;
  Waiting waiting;
  std::atomic<bool> is_connected{false}, wants_birth{false};
  int seq = 0;
  std::int64_t bd_seq = -1;  ///< of the last connection
  std::int64_t birth_ms = 0;
  std::vector<std::vector<SparkplugMetric>> published{};  ///< of each valve; empty: it has no birth
  std::jthread sampler{}, sender{};

  Parts(Engine& of, const MqttSettings& with)
      : engine(of),
        settings(with),
        client(with.broker, fmt::format("spoolflow-{}-{}", with.group, with.edge_node), "[mqtt]"),
        output(of.outputs().add("mqtt")),
        waiting(most_records(with, of.size())),
        published(of.size()) {
    (void)MQTTClient_setCallbacks(client.get(), this, &lost, &arrived, nullptr);
  }
  ~Parts() {
    sampler = {};
    sender = {};
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  static void lost(void* context, char*) { static_cast<Parts*>(context)->is_connected = false; }
  static int arrived(void* context, char* topic, int, MQTTClient_message* message) {
    auto& parts = *static_cast<Parts*>(context);
    ++parts.output->received;
    const std::string_view bytes(static_cast<const char*>(message->payload),
                                 static_cast<std::size_t>(message->payloadlen));
    if (fieldbus::asks_for_rebirth(bytes)) parts.wants_birth = true;
    MQTTClient_freeMessage(&message);
    MQTTClient_free(topic);
    return 1;
  }
  [[nodiscard]] std::string topic(const char* kind, const std::string& device = {}) const {
    return fmt::format("spBv1.0/{}/{}/{}{}{}", settings.group, kind, settings.edge_node, device.empty() ? "" : "/",
                       device);
  }
  [[nodiscard]] SparkplugMetric bd_metric(std::int64_t now_ms) const { return {"bdSeq", now_ms, bd_seq}; }

  bool publish(const std::string& to, const std::string& bytes, int qos = 0) {
    const int done = is_connected ? MQTTClient_publish(client.get(), to.c_str(), static_cast<int>(bytes.size()),
                                                       bytes.data(), qos, 0, nullptr)
                                  : MQTTCLIENT_DISCONNECTED;
    if (done == MQTTCLIENT_SUCCESS) {
      ++output->sent;
      return true;
    }
    is_connected = false;
    return false;
  }
  bool publish_next(const char* kind, const std::string& device, std::int64_t time_ms,
                    std::vector<SparkplugMetric> metrics) {
    const std::string bytes = fieldbus::sparkplug_bytes({time_ms, seq, std::move(metrics)});
    seq = (seq + 1) % 256;
    return publish(topic(kind, device), bytes);
  }

  /// With a new bdSeq, its death as the will. What failed is reported as trouble.
  bool connect() {
    bd_seq = (bd_seq + 1) % 256;
    const std::int64_t now = wall_ms();
    const std::string death = fieldbus::sparkplug_bytes({now, -1, {bd_metric(now)}}), death_topic = topic("NDEATH");
    MQTTClient_willOptions will = MQTTClient_willOptions_initializer;
    will.topicName = death_topic.c_str();
    will.payload = {static_cast<int>(death.size()), death.data()};
    will.qos = 1;
    int done = client.connect(&will);
    if (done == MQTTCLIENT_SUCCESS) done = MQTTClient_subscribe(client.get(), topic("NCMD").c_str(), 1);
    if (done != MQTTCLIENT_SUCCESS) {
      output->set_trouble(client.no_connection(done));
      return false;
    }
    output->set_trouble("");
    is_connected = true;
    return true;
  }

  bool give_birth() {
    wants_birth = false;
    seq = 0;
    birth_ms = wall_ms();
    std::vector<SparkplugMetric> node{bd_metric(birth_ms), {"Node Control/Rebirth", birth_ms, false}};
    if (!publish_next("NBIRTH", "", birth_ms, std::move(node))) return false;
    for (std::size_t k = 0; k < published.size(); ++k) {
      if (!publish_birth(k, birth_ms, answer_of(engine, k))) return false;
    }
    return true;
  }
  bool publish_birth(std::size_t k, std::int64_t time_ms, const PlantAnswer& answer) {
    published[k] = fieldbus::valve_metrics(answer, time_ms);
    return publish_next("DBIRTH", answer.id, time_ms, published[k]);
  }
  /// What was kept from before the birth comes whole; what is of now as far as it is new.
  bool publish_record(const Record& record) {
    const bool is_historical = record.time_ms < birth_ms;
    for (std::size_t k = 0; k < record.valves.size(); ++k) {
      const PlantAnswer& answer = record.valves[k];
      if (!is_historical && answer.stalled == published[k].empty()) {
        if (answer.stalled) continue;
      } else if (!is_historical && answer.stalled) {
        published[k].clear();
        if (!publish_next("DDEATH", answer.id, record.time_ms, {})) return false;
        continue;
      } else if (!is_historical) {
        if (!publish_birth(k, record.time_ms, answer)) return false;
        continue;
      }
      std::vector<SparkplugMetric> now = fieldbus::valve_metrics(answer, record.time_ms);
      std::vector<SparkplugMetric> news = now;
      if (is_historical) {
        if (answer.stalled || published[k].empty()) continue;
        for (SparkplugMetric& one : news) one.is_historical = true;
      } else {
        news = fieldbus::changed_metrics(published[k], now);
        published[k] = std::move(now);
      }
      if (!news.empty() && !publish_next("DDATA", answer.id, record.time_ms, std::move(news))) return false;
    }
    return true;
  }

  void sample(const std::stop_token& stop) {
    const auto period = std::chrono::duration_cast<std::chrono::steady_clock::duration>(
        std::chrono::duration<double>(settings.period_s));
    parallel::SteadyTime next = std::chrono::steady_clock::now();
    do {
      Record record{wall_ms()};
      for (std::size_t k = 0; k < engine.size(); ++k) record.valves.push_back(answer_of(engine, k));
      output->dropped += waiting.add(std::move(record));
      output->waiting = waiting.size();
      next = std::max(next + period, std::chrono::steady_clock::now());
    } while (parallel::wait_until(next, stop));
  }
  void send(const std::stop_token& stop) {
    constexpr std::chrono::milliseconds between_tries(1000), between_looks(20);
    while (!stop.stop_requested()) {
      output->connected = is_connected ? 1 : 0;
      if (!is_connected) {
        if (!connect() || !give_birth()) (void)parallel::wait_for(between_tries, stop);
        continue;
      }
      if (wants_birth && !give_birth()) continue;
      const auto next = waiting.oldest();
      if (!next) {
        (void)parallel::wait_for(between_looks, stop);
        continue;
      }
      if (publish_record(next->second)) waiting.remove(next->first);
      output->waiting = waiting.size();
    }
    if (!is_connected) return;
    const std::int64_t now = wall_ms();
    (void)publish(topic("NDEATH"), fieldbus::sparkplug_bytes({now, -1, {bd_metric(now)}}), 0);
    (void)MQTTClient_disconnect(client.get(), 500);
  }
};

MqttSender::MqttSender(Engine& engine, const MqttSettings& settings)
    : parts_(std::make_unique<Parts>(engine, settings)) {
  parts_->sampler = std::jthread([parts = parts_.get()](const std::stop_token& stop) { parts->sample(stop); });
  parts_->sender = std::jthread([parts = parts_.get()](const std::stop_token& stop) { parts->send(stop); });
}

MqttSender::~MqttSender() = default;

}  // namespace spoolflow::live

#include "addons/live/valve_sources.hpp"

#include <algorithm>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <thread>

#include "spoolflow/estimation/recordings/sensor_channels.hpp"

namespace spoolflow::live {

/// A thread that works on the samples of some of the valves.
struct ValveSources::Worker {
  explicit Worker(FirstSamples& first) : first_samples(first) {}

  FirstSamples& first_samples;
  std::mutex mutex{};
  std::condition_variable_any arrived{};
  std::vector<Place*> pending{};
  std::vector<SampleBlock> blocks{};  ///< of the valve that is worked on now
  std::jthread thread{};              ///< last: it uses the others

  void add(Place& place) {
    {
      const std::lock_guard lock(mutex);
      pending.push_back(&place);
    }
    arrived.notify_one();
  }
  /// All that waits for the valve; whatever has not come yet is not waited for.
  void work(Place& place) {
    place.intake->take(blocks);
    for (const SampleBlock& block : blocks) {
      place.valve->work(block);
      first_samples.take(place.number, block);
    }
  }
  void run(const std::stop_token& stop) {
    std::vector<Place*> now;
    while (!stop.stop_requested()) {
      {
        std::unique_lock lock(mutex);
        arrived.wait(lock, stop, [this] { return !pending.empty(); });
        now.clear();
        std::swap(now, pending);
      }
      for (Place* const place : now) work(*place);
    }
  }
};

ValveSources::ValveSources(const SiteSettings& site, const Valves& valves) : site_(site), first_samples_(site) {
  const std::size_t threads = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, valves.size());
  for (std::size_t k = 0; k < threads; ++k) workers_.push_back(std::make_unique<Worker>(first_samples_));
  for (std::size_t k = 0; k < valves.size(); ++k) {
    auto place = std::make_unique<Place>();
    place->valve = valves[k].get();
    place->number = k;
    Worker& worker = *workers_[k % threads];
    place->intake = std::make_unique<Intake>([&worker, at = place.get()] { worker.add(*at); });
    places_.push_back(std::move(place));
  }
}

ValveSources::~ValveSources() {
  end_threads();
}

void ValveSources::resume(std::size_t k, const SourcePosition& after, const IntakeCounters& before) {
  places_[k]->after = after;
  places_[k]->before = before;
}

void ValveSources::start() {
  for (const auto& worker : workers_) {
    worker->thread = std::jthread([at = worker.get()](const std::stop_token& stop) { at->run(stop); });
  }
  std::vector<UdpValve> senders;
  for (std::size_t k = 0; k < places_.size(); ++k) {
    if (!has_sessions(k)) continue;
    senders.push_back({site_.valves[k].id, places_[k]->intake.get(), places_[k]->after, site_.stalled_after_s});
  }
  if (site_.udp) udp_ = std::make_unique<UdpReceiver>(*site_.udp, site_.allow, senders);
  if (site_.mqtt_source) messages_ = std::make_unique<MessageSources>(*site_.mqtt_source);
  for (std::size_t k = 0; k < places_.size(); ++k) start_source(k);
}

void ValveSources::start_source(std::size_t k) {
  Place& place = *places_[k];
  const ValveSettings& settings = site_.valves[k];
  const recording::ReadOptions channels = estimation::sensor_channels(*settings.model.model, settings.channels);
  if (const auto* tcp = std::get_if<TcpSettings>(&settings.source)) {
    place.source = std::make_unique<TcpSource>(tcp->listen, site_.allow, channels, place.after, *place.intake);
  } else if (const auto* mqtt = std::get_if<MqttTopicSettings>(&settings.source)) {
    messages_->add(mqtt->topic, channels, place.after, *place.intake);
  } else if (const auto* pipe = std::get_if<PipeSettings>(&settings.source)) {
    place.source = std::make_unique<PipeSource>(pipe->path, channels, place.after, *place.intake);
  } else if (const auto* replay = std::get_if<ReplaySettings>(&settings.source)) {
    place.source = std::make_unique<ReplaySource>(*replay, channels, place.after, *place.intake);
  } else if (const auto* rig = std::get_if<RigSettings>(&settings.source)) {
    place.source = std::make_unique<RigSource>(*rig, place.after, *place.intake);
  }
}

void ValveSources::stop() {
  end_threads();
  for (const auto& place : places_) workers_.front()->work(*place);
}

/// Sources first, so that nothing new comes while the last is worked on.
void ValveSources::end_threads() {
  const auto ask_to_stop = [](auto* source) {
    if (source) (*source)->ask_to_stop();
  };
  for (const auto& place : places_) {
    ask_to_stop(std::get_if<std::unique_ptr<TcpSource>>(&place->source));
    ask_to_stop(std::get_if<std::unique_ptr<PipeSource>>(&place->source));
    ask_to_stop(std::get_if<std::unique_ptr<ReplaySource>>(&place->source));
    ask_to_stop(std::get_if<std::unique_ptr<RigSource>>(&place->source));
  }
  for (const auto& place : places_) place->source = {};
  udp_.reset();
  if (messages_) messages_->ask_to_stop();
  messages_.reset();
  for (const auto& worker : workers_) worker->thread = {};
}

void ValveSources::finish_ended() {
  for (std::size_t k = 0; k < places_.size(); ++k) {
    Place& place = *places_[k];
    // What was pushed last may still be in work for an instant; the next second comes behind it.
    if (place.finished || !ended(place) || !place.intake->empty() || !(view(k).age_s > 1)) continue;
    place.valve->finish();
    place.finished = true;
  }
}

bool ValveSources::ended(const Place& place) {
  const auto* replay = std::get_if<std::unique_ptr<ReplaySource>>(&place.source);
  return replay != nullptr && (*replay)->ended();
}

bool ValveSources::has_sessions(std::size_t k) const {
  return std::holds_alternative<UdpSettings>(site_.valves[k].source);
}

SourceView ValveSources::view(std::size_t k) const {
  const Place& place = *places_[k];
  SourceView out;
  out.kind = kind(site_.valves[k].source);
  if (const auto* tcp = std::get_if<std::unique_ptr<TcpSource>>(&place.source)) out.port = (*tcp)->port();
  out.counters = place.before + place.intake->counters();
  out.trouble = place.intake->trouble();
  out.unread = place.intake->unread();
  out.findings = first_samples_.findings(k);
  const std::int64_t arrived_ns = place.valve->arrived_ns();
  out.age_s =
      arrived_ns == 0 ? std::numeric_limits<double>::quiet_NaN() : 1e-9 * static_cast<double>(steady_ns() - arrived_ns);
  out.stalled = !ended(place) && !(out.age_s <= site_.stalled_after_s);
  return out;
}

}  // namespace spoolflow::live

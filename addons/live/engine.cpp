#include "addons/live/engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "addons/live/valve/event_text.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/parallel/pace.hpp"

namespace spoolflow::live {

/// A thread that works on the samples of some of the valves.
struct Engine::Worker {
  std::mutex mutex;
  std::condition_variable_any arrived;
  std::vector<Place*> pending;
  std::vector<SampleBlock> blocks;  ///< of the valve that is worked on now
  std::jthread thread;              ///< last: it uses the others

  void tell(Place& place) {
    {
      const std::lock_guard lock(mutex);
      pending.push_back(&place);
    }
    arrived.notify_one();
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
      for (Place* const place : now) {
        // All that waits for it; whatever has not come yet is not waited for.
        place->intake->take(blocks);
        for (const SampleBlock& block : blocks) place->valve->work(block);
      }
    }
  }
};

Engine::Engine(SiteSettings site, std::string program)
    : site_(std::move(site)), program_(std::move(program)), alarms_(site_.alarms) {
  const std::size_t threads = std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, site_.valves.size());
  for (std::size_t k = 0; k < threads; ++k) workers_.push_back(std::make_unique<Worker>());
  for (std::size_t k = 0; k < site_.valves.size(); ++k) {
    const ValveSettings& settings = site_.valves[k];
    auto place = std::make_unique<Place>();
    // Alarms are looked at each second: the oldest samples must last until then.
    const double raw_s = site_.store.empty() ? 0 : site_.raw_before_s + site_.raw_after_s + 2;
    place->valve = std::make_unique<ValveAtWork>(settings.id, settings.model, program_, raw_s);
    Worker& worker = *workers_[k % threads];
    place->intake = std::make_unique<Intake>([&worker, at = place.get()] { worker.tell(*at); });
    valves_.push_back(std::move(place));
  }
  if (site_.store.empty()) return;
  store_ = std::make_unique<Store>(site_.store);
  kept_before_ms_ = store_->newest().wall_ms;
  restore();
  if (!site_.fleet.servers.empty()) begin_to_publish();
}

void Engine::restore() {
  events_.restore(store_->events(static_cast<int>(Events::most)));
  alarms_.restore(store_->alarms(Alarms::most_cleared));
  for (const KeptState& kept : store_->states()) {
    const auto same = std::find_if(valves_.begin(), valves_.end(),
                                   [&](const auto& place) { return place->valve->id() == kept.valve; });
    if (same == valves_.end()) continue;
    (*same)->after = {kept.session, kept.next};
    (*same)->before = {kept.samples + kept.counts.dropped,
                       kept.counts.dropped,
                       kept.counts.lost,
                       kept.counts.repeated,
                       kept.counts.unreadable,
                       kept.counts.connections};
    const bool goes_on = (*same)->valve->restore(kept);
    (*same)->told_condition = (*same)->valve->view(false).condition;  // it was reported before
    if (goes_on) continue;
    events_.add({.wall_ms = wall_ms(),
                 .valve = kept.valve,
                 .kind = "program",
                 .text = "sensor and monitor are reset: the model or the program is another than before, or what was "
                         "kept is damaged"});
  }
}

Engine::~Engine() {
  try {
    stop();
  } catch (const std::exception&) {  // the store keeps what it has
  }
}

void Engine::start() {
  for (const auto& worker : workers_) {
    worker->thread = std::jthread([at = worker.get()](const std::stop_token& stop) { at->run(stop); });
  }
  std::vector<UdpValve> senders;
  for (std::size_t k = 0; k < valves_.size(); ++k) {
    if (std::holds_alternative<UdpSettings>(site_.valves[k].source)) {
      senders.push_back({site_.valves[k].id, valves_[k]->intake.get(), valves_[k]->after});
    }
  }
  if (site_.udp) udp_ = std::make_unique<UdpReceiver>(*site_.udp, site_.allow, senders);
  for (std::size_t k = 0; k < valves_.size(); ++k) start_source(k);
  keeper_ = std::jthread([this](const std::stop_token& stop) { keep_each_second(stop); });
}

void Engine::start_source(std::size_t k) {
  Place& place = *valves_[k];
  const ValveSettings& settings = site_.valves[k];
  const recording::ReadOptions channels = estimation::sensor_channels(*settings.model.model, settings.channels);
  if (const auto* tcp = std::get_if<TcpSettings>(&settings.source)) {
    place.source = std::make_unique<TcpSource>(tcp->listen, site_.allow, channels, place.after, *place.intake);
  } else if (const auto* pipe = std::get_if<PipeSettings>(&settings.source)) {
    place.source = std::make_unique<PipeSource>(pipe->path, channels, place.after, *place.intake);
  } else if (const auto* replay = std::get_if<ReplaySettings>(&settings.source)) {
    place.source = std::make_unique<ReplaySource>(*replay, channels, place.after, *place.intake);
  } else if (const auto* rig = std::get_if<RigSettings>(&settings.source)) {
    place.source = std::make_unique<RigSource>(*rig, place.after, *place.intake);
  }
}

void Engine::stop() {
  const bool worked = keeper_.joinable();
  keeper_ = {};  // it looks at the sources
  // Sources first, so that nothing new comes while the last is worked on.
  for (const auto& place : valves_) {
    std::visit(
        [](auto& source) {
          if constexpr (requires { source->ask_to_stop(); }) {
            if (source) source->ask_to_stop();
          }
        },
        place->source);
  }
  for (const auto& place : valves_) place->source = std::monostate{};
  udp_.reset();
  for (const auto& worker : workers_) worker->thread = {};
  if (!worked) return;
  std::vector<SampleBlock> blocks;
  for (const auto& place : valves_) {
    place->intake->take(blocks);
    for (const SampleBlock& block : blocks) place->valve->work(block);
  }
  if (store_) keep(true);
}

bool Engine::ended(const Place& place) const {
  const auto* replay = std::get_if<std::unique_ptr<ReplaySource>>(&place.source);
  return replay != nullptr && (*replay)->ended();
}

SourceView Engine::source(std::size_t k) const {
  const Place& place = *valves_[k];
  SourceView out;
  out.kind = kind(site_.valves[k].source);
  if (const auto* tcp = std::get_if<std::unique_ptr<TcpSource>>(&place.source)) out.port = (*tcp)->port();
  out.counters = place.before + place.intake->counters();
  out.trouble = place.intake->trouble();
  const std::int64_t arrived_ns = place.valve->arrived_ns();
  out.age_s =
      arrived_ns == 0 ? std::numeric_limits<double>::quiet_NaN() : 1e-9 * static_cast<double>(steady_ns() - arrived_ns);
  out.stalled = !ended(place) && !(out.age_s <= site_.stalled_after_s);
  return out;
}

ValveView Engine::view(std::size_t k) const {
  ValveView out = valves_[k]->valve->view();
  if (source(k).stalled) out.condition = std::max(out.condition, monitor::Ne107::function_check);
  return out;
}

UdpCounters Engine::udp_counters() const {
  return udp_ ? udp_->counters() : UdpCounters{};
}

Engine::StoreView Engine::store_view() const {
  const std::lock_guard lock(trouble_mutex_);
  return store_view_;
}

void Engine::note(const std::string& text) {
  events_.add({.wall_ms = wall_ms(), .kind = "program", .text = text});
  if (tell_) tell_(text);
}

/// Changes of condition and sources become events.
void Engine::watch_for_events() {
  for (std::size_t k = 0; k < valves_.size(); ++k) {
    Place& place = *valves_[k];
    const SourceView source_now = source(k);
    // What was pushed last may still be in work for an instant; the next second comes behind it.
    if (ended(place) && place.intake->empty() && source_now.age_s > 1 && !place.finished) {
      place.valve->finish();
      place.finished = true;
    }
    const ValveView valve = place.valve->view(false);
    const auto add = [&](const char* kind, std::string text) {
      events_.add(
          {.wall_ms = wall_ms(), .valve = valve.id, .time_s = valve.time_s, .kind = kind, .text = std::move(text)});
    };
    if (source_now.stalled != place.told_stalled) {
      add("source", source_now.stalled
                        ? fmt::format("no samples{}{}", source_now.trouble.empty() ? "" : ": ", source_now.trouble)
                        : "samples come in");
      place.told_stalled = source_now.stalled;
    } else if (source_now.trouble != place.told_trouble && !source_now.trouble.empty()) {
      add("source", source_now.trouble);
    }
    place.told_trouble = source_now.trouble;
    // Indicators take long: they are asked for where an alarm may keep them.
    follow_alarms(place, valve.condition == monitor::Ne107::good ? valve : place.valve->view(), source_now.stalled);
    keep_raw_samples(place, valve, source_now.stalled || place.finished);
    if (valve.condition == place.told_condition) continue;
    events_.add(condition_event(valve, place.told_condition, wall_ms()));
    place.told_condition = valve.condition;
  }
}

void Engine::follow_alarms(Place& place, const ValveView& valve, bool stalled) {
  for (const AlarmChange& change : alarms_.follow(valve, troubles_of(valve, stalled), wall_ms())) {
    const Alarm& alarm = change.alarm;
    events_.add(alarm_event(valve, change, wall_ms()));
    // Where nothing comes there is nothing to look at.
    if (change.kind == AlarmChange::Kind::gone || alarm.cause == no_samples) continue;
    place.alarms.push_back(alarm.id);
    if (place.alarm_s) continue;
    place.alarm_s = valve.time_s;
    place.alarm = fmt::format("alarm {}: {}", alarm.id, alarm.cause);
  }
}

std::optional<Alarm> Engine::acknowledge(std::int64_t alarm, const std::string& by) {
  std::optional<Alarm> found = alarms_.acknowledge(alarm, by, wall_ms());
  if (!found) return found;
  events_.add({.wall_ms = wall_ms(),
               .valve = found->valve,
               .kind = "alarm",
               .text = fmt::format("alarm {} acknowledged by {}: {}", found->id, by, found->cause)});
  return found;
}

}  // namespace spoolflow::live

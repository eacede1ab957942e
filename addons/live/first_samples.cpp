#include "addons/live/first_samples.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <limits>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "addons/live/gathered_samples.hpp"

namespace spoolflow::live {
namespace {

/// Each holds up to half a megabyte; the others wait for their turn.
constexpr int most_together = 64;
/// So much of what is implausible is gathered: its extremes tell its unit.
constexpr double implausible_s = 5;
/// So long a valve at rest keeps its turn, and so long the next one waits behind it.
constexpr double longest_rest_s = 120;

}  // namespace

/// Of one valve. What lies behind `connections` is shared; the rest is of the thread that takes its samples.
struct FirstSamples::Place {
  bool has_sender = false;
  bool wanted = true;  ///< of this sender nothing was judged yet
  double not_before_s = -std::numeric_limits<double>::infinity();
  std::unique_ptr<GatheredSamples> gathered{};

  std::atomic<std::uint64_t> connections = 0;  ///< which sender it is
  std::atomic<bool> again = false;             ///< the last judgement found something
  mutable std::mutex mutex{};
  std::vector<std::string> findings{};
};

struct FirstSamples::Parts {
  struct Task {
    std::size_t valve;
    std::uint64_t connections;
    std::unique_ptr<GatheredSamples> gathered;
  };

  const SiteSettings& site;
  std::vector<std::unique_ptr<Place>> places{};
  std::atomic<int> together = 0;
  std::mutex mutex{};
  std::condition_variable_any came{};
  std::vector<Task> waiting{};
  std::map<const model::Model*, std::vector<plausibility::KnownValve>> known{};  ///< of the thread
  std::jthread thread{};                                                         ///< last: it uses the others

  explicit Parts(const SiteSettings& of) : site(of) {}

  [[nodiscard]] std::unique_ptr<GatheredSamples> begun(std::size_t valve) const {
    const ValveSettings& settings = site.valves[valve];
    return std::make_unique<GatheredSamples>(settings.id, settings.model.model->valve.stroke_m,
                                             std::holds_alternative<UdpSettings>(settings.source));
  }
  [[nodiscard]] std::vector<std::string> findings_of(const Task& task) {
    task.gathered->finish();
    if (!task.gathered->implausible().empty()) return {task.gathered->implausible()};
    const model::Model& model = *site.valves[task.valve].model.model;
    if (!known.contains(&model)) known.emplace(&model, plausibility::known_valve(model));
    return task.gathered->findings(known.at(&model));
  }
  void judge(const Task& task) {
    std::vector<std::string> found;
    try {
      found = findings_of(task);
    } catch (const std::exception&) {  // of a model without what it takes: nothing is known
    }
    Place& place = *places[task.valve];
    const std::lock_guard lock(place.mutex);
    if (place.connections != task.connections) return;  // of a sender before
    place.again = !found.empty();
    place.findings = std::move(found);
  }
  void run(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      std::vector<Task> now;
      {
        std::unique_lock lock(mutex);
        came.wait(lock, stop, [this] { return !waiting.empty(); });
        std::swap(now, waiting);
      }
      for (const Task& task : now) {
        judge(task);
        --together;
      }
    }
  }
  void hand_over(std::size_t valve, std::unique_ptr<GatheredSamples> gathered) {
    {
      const std::lock_guard lock(mutex);
      waiting.push_back({valve, places[valve]->connections, std::move(gathered)});
    }
    came.notify_one();
  }
};

FirstSamples::FirstSamples(const SiteSettings& site) : parts_(std::make_unique<Parts>(site)) {
  for (const ValveSettings& valve : site.valves) {
    parts_->places.push_back(std::make_unique<Place>());
    parts_->places.back()->has_sender =
        std::holds_alternative<UdpSettings>(valve.source) || std::holds_alternative<TcpSettings>(valve.source) ||
        std::holds_alternative<MqttTopicSettings>(valve.source) || std::holds_alternative<PipeSettings>(valve.source);
  }
  parts_->thread = std::jthread([parts = parts_.get()](const std::stop_token& stop) { parts->run(stop); });
}

FirstSamples::~FirstSamples() = default;

void FirstSamples::take(std::size_t valve, const SampleBlock& block) {
  Place& place = *parts_->places[valve];
  if (!place.has_sender || block.samples.empty()) return;
  if (place.connections != block.counted.connections) {  // another sender, or the same that began again
    place.connections = block.counted.connections;
    place.wanted = true;
    place.not_before_s = -std::numeric_limits<double>::infinity();
    if (place.gathered) --parts_->together;
    place.gathered.reset();
    const std::lock_guard lock(place.mutex);
    place.findings.clear();
  }
  const double now_s = block.samples.back().time_s;
  if (!place.gathered) {
    if (place.again.exchange(false)) place.wanted = true;
    if (!place.wanted || now_s < place.not_before_s) return;
    if (parts_->together.fetch_add(1) >= most_together) {
      --parts_->together;
      return;
    }
    place.gathered = parts_->begun(valve);
  }
  GatheredSamples& gathered = *place.gathered;
  for (const estimation::TimedSample& sample : block.samples) gathered.take(sample);
  if (gathered.has_gap()) {
    place.gathered = parts_->begun(valve);
  } else if ((!gathered.implausible().empty() && gathered.length_s() >= implausible_s) ||
             (gathered.length_s() >= judged_s && gathered.moves())) {
    place.wanted = false;
    // What is implausible is so in each sample: it is looked at now and then.
    if (!gathered.implausible().empty()) place.not_before_s = now_s + judged_s;
    parts_->hand_over(valve, std::move(place.gathered));
  } else if (gathered.length_s() >= longest_rest_s) {
    place.gathered.reset();
    --parts_->together;
    place.not_before_s = now_s + longest_rest_s;
  }
}

std::vector<std::string> FirstSamples::findings(std::size_t valve) const {
  const Place& place = *parts_->places[valve];
  const std::lock_guard lock(place.mutex);
  return place.findings;
}

}  // namespace spoolflow::live

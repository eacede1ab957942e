#include "addons/live/notify/notifier.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <optional>
#include <thread>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

#include "addons/live/notify/alarm_news.hpp"
#include "addons/live/notify/delivery.hpp"
#include "spoolflow/parallel/pace.hpp"

namespace spoolflow::live {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds look_period(500);
constexpr std::chrono::seconds last_patience(3);
constexpr double longest_retry_s = 600;

Clock::duration seconds(double value) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(value));
}

/// The fleet's name of the site, else the machine's.
std::string site_name(const SiteSettings& site) {
  if (!site.fleet.site.empty()) return site.fleet.site;
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "live";
  return name.data();
}

/// The alarms that it was sent before, where the store has them; else it knows all that there is.
GatheredNews gathered_of(Engine& engine, const std::string& name, monitor::Ne107 least) {
  const std::optional<std::string> reported = engine.reported().of(name);
  return reported ? GatheredNews(*reported, engine.alarms(), least) : GatheredNews(engine.alarms(), least);
}

}  // namespace

struct Notifier::Receiver {
  Engine& engine;
  const NotifySettings& settings;
  std::string name;  ///< to the store
  std::string site;
  std::shared_ptr<Output> output;
  GatheredNews gathered;
  std::string trouble{};  ///< of the last try
  double wait_s;          ///< until the next try, where one fails
  std::optional<Clock::time_point> due{};
  std::jthread thread{};

  Receiver(Engine& of, const NotifySettings& with, std::string output_name, std::string name_to_store)
      : engine(of),
        settings(with),
        name(std::move(name_to_store)),
        site(site_name(of.site())),
        output(of.outputs().add(output_name)),
        gathered(gathered_of(of, name, with.least)),
        wait_s(with.retry_s) {
    thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  void look() {
    output->dropped += gathered.look(engine.alarms());
    output->waiting = gathered.news().size();
    engine.reported().set(name, gathered.written());
    if (gathered.news().empty()) {
      due.reset();
    } else if (!due) {
      due = Clock::now() + seconds(settings.gather_s);
    }
  }
  /// Whether it went out, or nothing had to.
  bool send(const std::stop_token& stop) {
    const std::int64_t now_ms = wall_ms();
    const std::string failed =
        deliver(settings, {subject_of(gathered, site), text_of(gathered, site), json_of(gathered, site, now_ms)}, stop);
    if (stop.stop_requested() && !failed.empty()) return false;
    if (failed.empty()) {
      if (!trouble.empty()) engine.note(fmt::format("{}: messages of alarms go out again", settings.name));
      ++output->sent;
      gathered.clear();
      engine.reported().set(name, gathered.written());
      output->waiting = 0;
      due.reset();
      wait_s = settings.retry_s;
    } else {
      if (failed != trouble) {
        engine.note(
            fmt::format("{}: no message of alarms goes out ({}); it is tried again with growing pauses, up to "
                        "{:.0f} s, and up to {} alarms wait",
                        settings.name, failed, std::max(longest_retry_s, settings.retry_s), GatheredNews::most));
      }
      due = Clock::now() + seconds(wait_s);
      wait_s = std::min(2 * wait_s, std::max(longest_retry_s, settings.retry_s));
    }
    trouble = failed;
    output->set_trouble(failed);
    return failed.empty();
  }
  void run(const std::stop_token& stop) {
    while (parallel::wait_for(look_period, stop)) {
      look();
      if (due && Clock::now() >= *due) (void)send(stop);
    }
  }
  /// After its thread.
  void finish() {
    look();
    if (gathered.news().empty()) return;
    std::stop_source enough;
    const std::jthread watch([&](const std::stop_token& done) {
      if (parallel::wait_for(last_patience, done)) enough.request_stop();
    });
    if (send(enough.get_token())) return;
    engine.note(fmt::format("{}: {} alarms were in no message when the program ended{}", settings.name,
                            gathered.news().size() + gathered.left_out(),
                            engine.site().store.empty() ? "" : "; the store keeps them for the next start"));
  }
};

Notifier::Notifier(Engine& engine) {
  const std::vector<NotifySettings>& all = engine.site().notify;
  std::map<std::string, int> of_the_name;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const std::string name = fmt::format("{} {}", all[k].name, ++of_the_name[all[k].name]);
    receivers_.push_back(std::make_unique<Receiver>(engine, all[k], fmt::format("notify_{}", k + 1), name));
  }
}

Notifier::~Notifier() {
  for (const auto& one : receivers_) one->thread.request_stop();
  std::vector<std::jthread> last;
  for (const auto& one : receivers_) {
    last.emplace_back([at = one.get()] {
      at->thread = {};
      at->finish();
    });
  }
}

}  // namespace spoolflow::live

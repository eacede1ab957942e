#pragma once
/// A site at work: its sources, the threads that work on their samples, and the store that keeps them. Its parts do the
/// work, each behind a header of its own; the engine puts them together, beats their seconds and answers the page.
///
///     live::Engine engine(live::read_site("site.toml"), "spoolflow 1.2");
///     engine.start();                   // from here on samples come in
///     engine.view(0); engine.events();  // from any thread
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "addons/live/journal.hpp"
#include "addons/live/outputs.hpp"
#include "addons/live/site.hpp"
#include "addons/live/site_keeper.hpp"
#include "addons/live/valve_sources.hpp"
#include "addons/live/valve_watch.hpp"

namespace spoolflow::live {

class Engine {
 public:
  /// Opens the store and lets the valves go on from it. Throws StoreError. `program`: name and version.
  Engine(SiteSettings site, const std::string& program);
  /// Stops sources and work, and keeps what there is.
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Before the start: who reports the program's own events beside the page, such as at standard error.
  void report_by(std::function<void(const std::string&)> report) { journal_.report = std::move(report); }
  /// Before the start: which clocks it goes by; without it the machine's.
  void go_by(std::function<Instant()> clock) { clock_ = std::move(clock); }
  /// Throws SiteError or RecordingError where a source cannot begin.
  void start();
  /// Ends sources and work, and keeps what there is; every reader of views may go on.
  void stop();

  [[nodiscard]] const SiteSettings& site() const { return site_; }
  [[nodiscard]] std::size_t size() const { return valves_.size(); }
  [[nodiscard]] const ValveAtWork& valve(std::size_t k) const { return *valves_[k]; }
  /// The condition is function check at least while the source is stalled.
  [[nodiscard]] ValveView view(std::size_t k) const;
  [[nodiscard]] SourceView source(std::size_t k) const { return sources_.view(k); }
  [[nodiscard]] UdpCounters udp_counters() const { return sources_.udp_counters(); }
  [[nodiscard]] std::vector<UnknownSender> unknown_senders() const { return sources_.unknown_senders(); }
  /// Where the messages of the site's broker go; null where it has none. From the start until stop().
  [[nodiscard]] MessageSources* messages() { return sources_.messages(); }
  [[nodiscard]] const MessageSources* messages() const { return sources_.messages(); }
  [[nodiscard]] std::uint16_t udp_port() const { return sources_.udp_port(); }
  [[nodiscard]] StoreView store_view() const { return keeper_ ? keeper_->view() : StoreView{}; }
  [[nodiscard]] std::vector<Event> events() const { return journal_.events.all(); }
  [[nodiscard]] std::vector<Alarm> alarms() const { return journal_.alarms.all(); }
  /// The alarm as it is then; nothing where there is none of this number. It is kept with the next second's commit.
  std::optional<Alarm> acknowledge(std::int64_t alarm, const std::string& by);
  /// Likewise: it is shelved for so long; one that is gone and acknowledged stays as it was.
  std::optional<Alarm> shelve(std::int64_t alarm, const std::string& by, double hours);
  std::optional<Alarm> unshelve(std::int64_t alarm, const std::string& by);
  std::optional<Alarm> comment(std::int64_t alarm, const std::string& by, const std::string& text);
  /// Something of the program itself that people should know: an event, and reported as report_by() sets.
  void note(const std::string& text) { journal_.note(text); }
  /// What receivers of messages have; kept where the site has a store.
  [[nodiscard]] ReportedAlarms& reported() { return journal_.reported; }
  /// The fleet has the valve's blocks up to that number: they need not be kept any longer.
  void covered(const std::string& valve, std::uint64_t number);
  /// How what goes out beside the page fares, and where it is counted.
  [[nodiscard]] Outputs& outputs() { return outputs_; }
  [[nodiscard]] const Outputs& outputs() const { return outputs_; }

 private:
  void beat(const std::stop_token& stop);
  void follow_clock();
  void report_alarm(const std::optional<Alarm>& alarm, const std::string& what);

  SiteSettings site_;
  Outputs outputs_;
  Valves valves_;
  Journal journal_;
  ValveSources sources_;
  std::optional<SiteKeeper> keeper_;  ///< where the site has a store
  ValveWatch watch_;
  std::function<Instant()> clock_ = instant;
  std::optional<Instant> clock_before_{};
  std::jthread beat_;  ///< last: it uses the others
};

}  // namespace spoolflow::live

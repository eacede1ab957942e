#pragma once
/// A site at work: its sources, the threads that work on their samples, and the store that keeps them.
///
///     live::Engine engine(live::read_site("site.toml"), "spoolflow 1.2");
///     engine.start();                   // from here on samples come in
///     engine.view(0); engine.events();  // from any thread
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "addons/live/outputs.hpp"
#include "addons/live/site.hpp"
#include "addons/live/sources/csv_source.hpp"
#include "addons/live/sources/intake.hpp"
#include "addons/live/sources/udp_receiver.hpp"
#include "addons/live/valve/alarms.hpp"
#include "addons/live/valve/events.hpp"
#include "addons/live/valve/valve_at_work.hpp"

namespace spoolflow::live {

/// How a valve's source fares.
struct SourceView {
  std::string_view kind;
  std::uint16_t port = 0;   ///< of tcp
  IntakeCounters counters;  ///< since the store began; without one, since the start
  std::string trouble;      ///< empty: none
  bool stalled = false;     ///< no sample for longer than the site allows; a recording that has ended is not stalled
  double age_s = 0;         ///< since the last sample; NaN: none yet
};

class Engine {
 public:
  /// Opens the store and lets the valves go on from it. Throws StoreError. `program`: name and version.
  Engine(SiteSettings site, std::string program);
  /// Stops sources and work, and keeps what there is.
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Throws SiteError or RecordingError where a source cannot begin.
  void start();
  /// Ends sources and work, and keeps what there is; every reader of views may go on.
  void stop();

  [[nodiscard]] std::size_t size() const { return valves_.size(); }
  [[nodiscard]] const ValveAtWork& valve(std::size_t k) const { return *valves_[k]->valve; }
  /// The condition is function check at least while the source is stalled.
  [[nodiscard]] ValveView view(std::size_t k) const;
  [[nodiscard]] SourceView source(std::size_t k) const;
  [[nodiscard]] std::vector<Event> events() const { return events_.all(); }
  [[nodiscard]] std::vector<Alarm> alarms() const { return alarms_.all(); }
  /// The alarm as it is then; nothing where there is none of this number. It is kept with the next second's commit.
  std::optional<Alarm> acknowledge(std::int64_t alarm, const std::string& by);
  /// The fleet has the valve's blocks up to that number: they need not be kept any longer.
  void covered(const std::string& valve, std::uint64_t number);
  [[nodiscard]] UdpCounters udp_counters() const;
  [[nodiscard]] std::uint16_t udp_port() const { return udp_ ? udp_->port() : std::uint16_t{0}; }
  /// How the store fares.
  struct StoreView {
    std::string trouble{};       ///< why nothing is kept at present; empty where it is, or where it need not be
    std::string mended{};        ///< what was done last about a file that was deleted or damaged; empty: nothing
    std::int64_t mended_ms = 0;  ///< when, since 1970-01-01 UTC
    std::uint64_t mendings = 0;  ///< since the start: whoever reads the file opens it again after each
  };
  [[nodiscard]] StoreView store_view() const;
  /// Something of the program itself that people should know: an event, and reported as tell_by() sets.
  void note(const std::string& text);
  /// Before the start: who reports the program's own events beside the page, such as at standard error.
  void tell_by(std::function<void(const std::string&)> tell) { tell_ = std::move(tell); }
  /// Before the start: which clocks it goes by; without it the machine's.
  void go_by(std::function<Instant()> clock) { clock_ = std::move(clock); }
  [[nodiscard]] const SiteSettings& site() const { return site_; }
  /// How what goes out beside the page fares, and where it is counted.
  [[nodiscard]] Outputs& outputs() { return outputs_; }
  [[nodiscard]] const Outputs& outputs() const { return outputs_; }

 private:
  struct Worker;
  /// One valve with what brings its samples.
  struct Place {
    std::unique_ptr<ValveAtWork> valve;
    std::unique_ptr<Intake> intake;
    SourcePosition after;
    IntakeCounters before{};  ///< what the store has of its source's counts at the start
    std::variant<std::monostate, std::unique_ptr<TcpSource>, std::unique_ptr<PipeSource>, std::unique_ptr<ReplaySource>,
                 std::unique_ptr<RigSource>>
        source;
    bool finished = false;  ///< its recording was played to the end
    bool told_stalled = false;
    monitor::Ne107 told_condition = monitor::Ne107::good;
    std::string told_trouble;
    std::optional<double> alarm_s{};  ///< by the source's clock; its raw samples are still to be kept
    std::string alarm{};
    std::vector<std::int64_t> alarms{};        ///< that were raised since then
    std::optional<OutboxPosition> reported{};  ///< the newest report to the fleet, where it gets no samples
  };

  void start_source(std::size_t k);
  void keep_each_second(const std::stop_token& stop);
  void restore();
  void begin_to_publish();
  void keep(bool with_indicators);
  [[nodiscard]] ValveCommit commit_of(std::size_t k, bool with_indicators) const;
  void look_after_store(std::int64_t now_ms);
  void follow_clock();
  void report(std::int64_t now_ms, std::vector<ValveCommit>& commits, const std::vector<Event>& events,
              const std::vector<Alarm>& alarms) const;
  void tell_given_up(std::uint64_t blocks, bool keeps);
  void forget_covered();
  [[nodiscard]] bool ended(const Place& place) const;
  void watch_for_events();
  void follow_alarms(Place& place, const ValveView& valve, bool stalled);
  void keep_raw_samples(Place& place, const ValveView& valve, bool nothing_comes);

  SiteSettings site_;
  Outputs outputs_;
  std::string program_;
  std::unique_ptr<Store> store_;
  std::vector<std::unique_ptr<Place>> valves_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::unique_ptr<UdpReceiver> udp_;
  Events events_;
  Alarms alarms_;
  mutable std::mutex covered_mutex_;
  std::map<std::string, std::uint64_t> covered_;  ///< valves whose blocks can go, up to that number
  std::uint64_t blocks_given_up_ = 0;             ///< since the store keeps nothing
  mutable std::mutex trouble_mutex_;
  StoreView store_view_;
  std::string mended_;  ///< reported once the store has all again that was known
  std::function<void(const std::string&)> tell_;
  std::function<Instant()> clock_ = instant;
  std::int64_t kept_before_ms_ = 0;  ///< by the system's clock, the newest row before the start; 0: there is none
  std::optional<Instant> clock_before_{};
  std::jthread keeper_;
};

}  // namespace spoolflow::live

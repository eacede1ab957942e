#pragma once
/// What brings the samples of a site's valves, and the threads that work on them.
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "addons/live/first_samples.hpp"
#include "addons/live/message_sources.hpp"
#include "addons/live/site.hpp"
#include "addons/live/sources/csv_source.hpp"
#include "addons/live/sources/intake.hpp"
#include "addons/live/sources/udp_receiver.hpp"

namespace spoolflow::live {

/// A site's valves at work, in the order of its file.
using Valves = std::vector<std::unique_ptr<ValveAtWork>>;

/// How a valve's source fares.
struct SourceView {
  std::string_view kind;
  std::uint16_t port = 0;   ///< of tcp
  IntakeCounters counters;  ///< since the store began; without one, since the start
  std::string trouble;      ///< empty: none
  std::string unread;       ///< columns of the sender that may be meant and are not read; empty: none
  bool stalled = false;     ///< no sample for longer than the site allows; a recording that has ended is not stalled
  double age_s = 0;         ///< since the last sample; NaN: none yet
  std::vector<std::string> findings{};  ///< what speaks against the sender's first samples (first_samples.hpp)
};

class ValveSources {
 public:
  /// Both outlive it.
  ValveSources(const SiteSettings& site, const Valves& valves);
  /// Ends sources and threads; what had come stays without work.
  ~ValveSources();

  /// Before the start: the source of valve `k` goes on behind that sample, its counts from those.
  void resume(std::size_t k, const SourcePosition& after, const IntakeCounters& before);
  /// Throws SiteError or RecordingError where a source cannot begin.
  void start();
  /// Ends sources, then threads, and works on what had come.
  void stop();
  /// To be called each second: a valve whose recording was played to the end has its monitor judge what it gathered.
  void finish_ended();

  [[nodiscard]] SourceView view(std::size_t k) const;
  /// Its recording was played to the end, and worked on.
  [[nodiscard]] bool finished(std::size_t k) const { return places_[k]->finished; }
  /// Its senders number their samples by sessions, whose count belongs to the sample that was worked on last.
  [[nodiscard]] bool has_sessions(std::size_t k) const;
  [[nodiscard]] UdpCounters udp_counters() const { return udp_ ? udp_->counters() : UdpCounters{}; }
  [[nodiscard]] std::vector<UnknownSender> unknown_senders() const {
    return udp_ ? udp_->unknown_senders() : std::vector<UnknownSender>{};
  }
  /// Of the site's broker; null where it has none, or before the start. It lives until stop().
  [[nodiscard]] MessageSources* messages() const { return messages_.get(); }
  [[nodiscard]] std::uint16_t udp_port() const { return udp_ ? udp_->port() : std::uint16_t{0}; }

 private:
  struct Worker;
  struct Place {
    ValveAtWork* valve;
    std::size_t number = 0;
    std::unique_ptr<Intake> intake;
    SourcePosition after{};
    IntakeCounters before{};  ///< what the store has of its counts at the start
    std::variant<std::monostate, std::unique_ptr<TcpSource>, std::unique_ptr<PipeSource>, std::unique_ptr<ReplaySource>,
                 std::unique_ptr<RigSource>>
        source{};
    bool finished = false;
  };
  void start_source(std::size_t k);
  void end_threads();
  [[nodiscard]] static bool ended(const Place& place);

  const SiteSettings& site_;
  FirstSamples first_samples_;
  std::vector<std::unique_ptr<Place>> places_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::unique_ptr<UdpReceiver> udp_;
  std::unique_ptr<MessageSources> messages_;
};

}  // namespace spoolflow::live

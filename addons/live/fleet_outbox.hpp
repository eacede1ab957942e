#pragma once
/// What a site keeps for its fleet until that has it: numbered blocks of samples, or of what it made of them.
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "addons/live/journal.hpp"
#include "addons/live/valve_sources.hpp"

namespace spoolflow::live {

class FleetOutbox {
 public:
  /// Numbers go on from those of the store. All outlive it. Throws StoreError.
  FleetOutbox(const SiteSettings& site, const Valves& valves, Store& store, Journal& journal);

  /// Adds to each commit what the fleet gets of it where it gets no samples, so that one transaction has both.
  void add_reports(std::int64_t now_ms, std::vector<ValveCommit>& commits, const std::vector<Event>& events,
                   const std::vector<Alarm>& alarms) const;
  /// These are kept: their numbers are given away.
  void committed(const std::vector<ValveCommit>& commits);
  /// Deletes what the fleet has from the store. Throws StoreError: it is named again by the fleet.
  void forget_covered();
  /// Before a commit that could not be kept is given back to its valve: a report is made again, with what comes until
  /// then.
  void withdraw(std::size_t k, ValveCommit& commit) const;
  /// So many blocks were given up in memory as the store keeps nothing; `keeps`: whether it does so again. What was
  /// lost is reported once at the beginning and once at the end.
  void given_up(std::uint64_t blocks, bool keeps);
  /// The fleet has the valve's blocks up to that number. From any thread.
  void covered(const std::string& valve, std::uint64_t number);

 private:
  /// How much waits in memory at most, of all valves [MB].
  [[nodiscard]] double memory_MB() const;

  const SiteSettings& site_;
  const Valves& valves_;
  Store& store_;
  Journal& journal_;
  std::vector<std::optional<OutboxPosition>> reported_;  ///< a valve's newest report, where the fleet gets no samples
  std::uint64_t given_up_ = 0;                           ///< blocks, since the store keeps nothing
  std::mutex covered_mutex_;
  std::map<std::string, std::uint64_t> covered_;  ///< valves whose blocks can go, up to that number
};

}  // namespace spoolflow::live

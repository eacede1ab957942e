#pragma once
/// Keeps what a site knows in its store, each second in one transaction, and says how the store fares.
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "addons/live/fleet_outbox.hpp"
#include "addons/live/journal.hpp"
#include "addons/live/valve_sources.hpp"

namespace spoolflow::live {

/// How the store fares.
struct StoreView {
  std::string trouble{};       ///< why nothing is kept at present; empty where it is, or where it need not be
  std::int64_t kept_ms = 0;    ///< up to when all is kept, since 1970-01-01 UTC; 0: nothing is since the start
  std::string mended{};        ///< what was done last about a file that was deleted or damaged; empty: nothing
  std::int64_t mended_ms = 0;  ///< when, since 1970-01-01 UTC
  std::uint64_t mendings = 0;  ///< since the start: readers of the file open it again after each
};

class SiteKeeper {
 public:
  /// Opens the store that the site names, lets valves, sources and journal go on from it, and begins to keep blocks for
  /// the fleet where the site has one. All outlive it. Throws StoreError.
  SiteKeeper(const SiteSettings& site, const Valves& valves, ValveSources& sources, Journal& journal);

  /// One transaction with all that came since the last; where it fails, that comes again with the next.
  void keep(const Instant& now, bool with_indicators);
  /// Deletes what is older or more than the site keeps.
  void retain();
  /// From any thread.
  [[nodiscard]] StoreView view() const;
  [[nodiscard]] Store& store() { return store_; }
  /// Null where the site has no fleet.
  [[nodiscard]] FleetOutbox* outbox() { return outbox_ ? &*outbox_ : nullptr; }
  /// Of the newest row before the start, by the system's clock; 0: there is none.
  [[nodiscard]] std::int64_t kept_before_ms() const { return kept_before_ms_; }

 private:
  void restore();
  void look_after_store(std::int64_t now_ms);
  [[nodiscard]] ValveCommit commit_of(std::size_t k, bool with_indicators) const;
  [[nodiscard]] std::vector<ValveCommit> commits(bool with_indicators) const;
  /// Returns why it is not kept; empty: it is.
  [[nodiscard]] std::string commit(const Instant& now, std::vector<ValveCommit>& commits);
  void report(const std::string& trouble, std::int64_t now_ms);

  const SiteSettings& site_;
  const Valves& valves_;
  ValveSources& sources_;
  Journal& journal_;
  Store store_;
  std::int64_t kept_before_ms_;
  std::optional<FleetOutbox> outbox_;
  std::string mended_;  ///< reported once the store has all again that was known
  mutable std::mutex view_mutex_;
  StoreView view_;
};

}  // namespace spoolflow::live

#pragma once
/// The page of a fleet and its interface: reads PostgreSQL, and keeps there what people do with alarms.
///
///     fleet::FleetPage fleet(settings);
///     const live::PageServer server(fleet.content(), settings.page);
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "addons/fleet/page/fleet_now.hpp"
#include "addons/fleet/settings.hpp"
#include "addons/live/http/page_content.hpp"

namespace spoolflow::fleet {

/// To be used by one thread at a time; long_answer() by another one.
class FleetPage {
 public:
  /// Throws ServerAway or ServerRefuses.
  explicit FleetPage(const FleetSettings& settings);
  /// Refers to this page.
  [[nodiscard]] live::PageContent content();

  /// `target` as the request has it.
  [[nodiscard]] live::PageAnswer answer(std::string_view method, std::string_view target);
  /// Hours and days of a valve, by a session of its own.
  [[nodiscard]] live::PageAnswer long_answer(std::string_view method, std::string_view target);
  /// Its alarm: "SITE/ID/NUMBER". Nothing where that is no alarm's name.
  [[nodiscard]] std::optional<live::PageAnswer> act_on_alarm(const live::AlarmOrder& order, const std::string& by);

 private:
  using Clock = std::chrono::steady_clock;
  Session& session();
  [[nodiscard]] live::PageAnswer done(const live::AlarmOrder& order, const AlarmAct& act);
  [[nodiscard]] live::PageAnswer days_of(std::string_view target);
  [[nodiscard]] live::PageAnswer found(std::string_view path, std::string_view target);
  const std::vector<ShownValve>& valves();
  const Distributions& spread();
  void learn_series(const std::vector<ValveNow>& valves);

  std::string connection_;
  std::optional<Session> session_, long_session_;
  std::map<std::string, std::string> series_;  ///< by model hash
  std::vector<ShownValve> valves_;
  std::optional<Clock::time_point> read_, spread_read_;
  Distributions spread_;
};

}  // namespace spoolflow::fleet

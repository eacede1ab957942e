#pragma once
/// What a page shows of the whole fleet, read from its tables; and that somebody has seen an alarm.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "addons/fleet/store/postgresql.hpp"
#include "addons/live/history/long_history.hpp"
#include "addons/live/history/store.hpp"

namespace spoolflow::fleet {

/// A valve as of its last committed block.
struct ValveNow {
  std::int64_t number = 0;
  std::string id{};            ///< "SITE/ID"
  std::string model_sha256{};  ///< in force
  std::int64_t wall_ms = 0;    ///< of the site's clock
  double age_s = 0;            ///< since the block was committed, by the database's clock
  std::uint64_t samples = 0;   ///< since its record began
  double energy_J = 0;         ///< likewise
  live::Summary last{};        ///< of that block
};
/// Ascending by id.
[[nodiscard]] std::vector<ValveNow> valves_now(Session& session);

/// Of the valve of that name; nothing where there is none.
[[nodiscard]] std::optional<std::int64_t> valve_number(Session& session, const std::string& valve);

struct IndicatorNow {
  std::int64_t valve = 0;  ///< its number
  live::KeptIndicator indicator{};
};
/// Those of the newest minute of each valve, by valve.
[[nodiscard]] std::vector<IndicatorNow> indicators_now(Session& session);

/// The packed model file of that hash; nothing where there is none.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> packed_model(Session& session, const std::string& sha256);

/// All that are not cleared, and the newest of the others; newest first. Acknowledged as soon as somebody has
/// acknowledged them. `valve`: of one alone; empty: of all.
[[nodiscard]] std::vector<live::Alarm> fleet_alarms(Session& session, const std::string& valve, int most_cleared);
/// Keeps that it was seen; its worker takes it with the next commit. One that was acknowledged before stays as it was.
/// Nothing where there is no such alarm.
[[nodiscard]] std::optional<live::Alarm> acknowledge(Session& session, const std::string& valve, std::int64_t alarm,
                                                     const std::string& by, std::int64_t wall_ms);

/// Newest first. `valve`: of one alone; empty: of all.
[[nodiscard]] std::vector<live::Event> fleet_events(Session& session, const std::string& valve, int most);

/// Thinned as live::read_flow() does.
[[nodiscard]] std::vector<live::FlowPoint> flow_days(Session& session, std::int64_t valve, const live::Span& span);
/// As live::read_indicators(), each with its unit.
struct KeptDays {
  std::string name{}, unit{};
  std::vector<live::IndicatorPoint> points{};
};
[[nodiscard]] std::vector<KeptDays> indicator_days(Session& session, std::int64_t valve, const live::Span& span);

}  // namespace spoolflow::fleet

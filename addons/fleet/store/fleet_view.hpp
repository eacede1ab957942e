#pragma once
/// What a page shows of the whole fleet, read from its tables.
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

#pragma once
/// One virtual unit of a series: measured, calibrated in every way, and judged.
#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "spoolflow/model/model.hpp"
#include "spoolflow/rig/bench/protocol.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::analysis {

/// The model that calibration makes of a virtual valve's own bench recordings, at four pressure levels. Kept in memory:
/// nothing is written.
[[nodiscard]] model::Model virtual_model(const rig::ValveAndCampaign& asked, unsigned workers,
                                         const std::function<void(double)>& progress);

/// What is known of a unit, the least first.
enum class KnownBy : unsigned char {
  type,     ///< nothing: the type's model
  strokes,  ///< strokes with the pump off and the planned minute, by the valve's own electronics
  minute,   ///< the planned minute with flow meter and pressure difference
  campaign  ///< force benches of its own, at four pressure differences
};
inline constexpr std::array all_known_by{KnownBy::type, KnownBy::strokes, KnownBy::minute, KnownBy::campaign};
[[nodiscard]] const char* name(KnownBy by);  ///< a word for files

/// The runs that judge, the same for every unit.
inline constexpr std::array series_run_names{"slow_ramps", "duty", "dithered_duty"};
inline constexpr std::size_t series_runs = series_run_names.size();

/// The sensor over one run: shares of the rated flow, and of the samples.
struct SeriesFigures {
  double p95, largest;  ///< of the errors' magnitudes
  double in_band;       ///< share of the samples whose 95 % band holds the true flow
  double band_width;    ///< mean, from its lower end to its upper one
};

/// One unit by one of its models.
struct SeriesJudged {
  std::array<SeriesFigures, series_runs> runs{};
  std::string refusal{};  ///< why calibration made no model, and there are no figures; empty: it made one
};

struct SeriesStudyUnit {
  std::uint64_t spread_seed;  ///< [spread] `seed` of the valve file that is this unit
  std::array<SeriesJudged, all_known_by.size()> by;

  [[nodiscard]] const SeriesJudged& judged(KnownBy known) const { return by[static_cast<std::size_t>(known)]; }
};

/// What is the same for every unit.
struct SeriesPlan {
  const model::Model& type;
  std::string type_file;
  rig::Protocol minute;
  std::array<rig::Protocol, series_runs> judging;
  std::uint64_t seed;  ///< of the courses of the judging runs
};

/// `valve` is that unit, before its spread. Throws what is no refusal by calibration.
[[nodiscard]] SeriesStudyUnit judged_unit(const SeriesPlan& plan, const rig::ValveAndCampaign& unit);

}  // namespace spoolflow::analysis

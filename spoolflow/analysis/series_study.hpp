#pragma once
/// What a type's model, a minute of each unit and a campaign of its own are worth over a whole series of virtual units,
/// judged beside each other on the same runs against the true flow.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "spoolflow/analysis/study.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::analysis {

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

/// Over the units that have a model; NaN where none has.
struct SeriesQuantiles {
  double median, low, high;  ///< 5 % of the units lie below `low`, 5 % above `high`, between two by straight lines
};

struct SeriesStudy {
  std::string valve;
  std::uint64_t seed;
  double minute_s;                        ///< the planned minute's length
  std::array<double, series_runs> run_s;  ///< length of each
  std::vector<SeriesStudyUnit> units;

  [[nodiscard]] std::size_t refused(KnownBy by) const;
  [[nodiscard]] SeriesQuantiles over_units(KnownBy by, std::size_t run, double SeriesFigures::*figure) const;
  /// Share of the units with a model whose band holds at least `held_share` of the run's samples.
  [[nodiscard]] double holding(KnownBy by, std::size_t run) const;
};
inline constexpr double held_share = 0.93;

/// `units` of the valve `asked`, drawn with its manufacturing spread (amount 1 where its file states none) by `seed`.
/// Each is measured, calibrated by `type`, from `type_file`, and by itself, and judged. The result follows from these
/// alone, whatever the threads and interruptions. Throws CalibrationError where `type` is no type's model, ModelError
/// where it is not of that valve's stroke and rated flow.
[[nodiscard]] SeriesStudy series_study(const model::Model& type, const std::string& type_file,
                                       const rig::ValveAndCampaign& asked, std::size_t units, std::uint64_t seed,
                                       const StudyWork& work);

}  // namespace spoolflow::analysis

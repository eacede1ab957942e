#pragma once
/// What a type's model, a minute of each unit and a campaign of its own are worth over a whole series of virtual units,
/// judged beside each other on the same runs against the true flow.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "spoolflow/analysis/study.hpp"
#include "spoolflow/analysis/virtual_unit.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"

namespace spoolflow::analysis {

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

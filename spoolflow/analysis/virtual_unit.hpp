#pragma once
/// One virtual unit of a series: measured, calibrated in every way, and judged.
#include "spoolflow/analysis/series_study.hpp"
#include "spoolflow/rig/bench/protocol.hpp"

namespace spoolflow::analysis {

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

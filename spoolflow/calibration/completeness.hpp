#pragma once
/// Whether a campaign holds what calibration cannot do without, before any of its samples is read.
#include <string>
#include <vector>

#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/recording/read_options.hpp"

namespace spoolflow::calibration {

/// The directions of which there are bench recordings: "b", "a" or both.
[[nodiscard]] std::vector<std::string> bench_directions(const recording::Campaign& campaign);

/// How each of the campaign's recordings is read, in its order, with the campaign's channel map where a file has the
/// columns. Throws CalibrationError that lists every missing test, every missing channel and every entry of the
/// campaign's channel map of which no file has the column, each with what to do.
[[nodiscard]] std::vector<recording::ReadOptions> complete_read_options(const recording::Campaign& campaign);

/// The same of a unit's recordings, which are by its own solenoid: any number of them, with whatever instruments; those
/// of both coils where the type is of a `whole` valve.
[[nodiscard]] std::vector<recording::ReadOptions> unit_read_options(const recording::Campaign& unit, bool whole);

}  // namespace spoolflow::calibration

#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "spoolflow/calibration/type/series.hpp"
#include "spoolflow/report/text/reader_units.hpp"

namespace spoolflow::report {

/// A series of units as one page: what needs a look first, spread, capability and drift of each direction, every unit
/// over its serial number, and the units at the edge or beyond; of a whole valve each direction after the other.
/// `series` has one or two, of the same units. `origin` stands below the title: where and when.
void write_series_report(std::ostream& out, const std::vector<calibration::Series>& series, const std::string& origin,
                         const ReaderUnits& units);

}  // namespace spoolflow::report

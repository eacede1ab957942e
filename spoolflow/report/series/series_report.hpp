#pragma once
#include <iosfwd>
#include <string>

#include "spoolflow/calibration/type/series.hpp"
#include "spoolflow/report/text/reader_units.hpp"

namespace spoolflow::report {

/// A series of units as one page: what needs a look first, spread, capability and drift of each direction, every unit
/// over its serial number, and the units at the edge or beyond. `origin` stands below the title: where and when.
void write_series_report(std::ostream& out, const calibration::Series& series, const std::string& origin,
                         const ReaderUnits& units);

}  // namespace spoolflow::report

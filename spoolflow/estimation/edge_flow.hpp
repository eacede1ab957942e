#pragma once
/// What metering edges pass at a measured pressure difference. No force errs in it: so it shows how late a meter is.
#include <span>
#include <vector>

#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::estimation {

/// The observers whose edges the oil passes: where the position is > 0, and of a whole valve where it is < 0.
struct PassedEdges {
  const sensor::ObserverParameters<double>* open;
  const sensor::ObserverParameters<double>* open_to_a = nullptr;
};

/// Flow in m3/s, an entry a sample, by the orifice equation; < 0 through the edge of positions < 0. Of the
/// pressure difference, as long as `position_m`, the size counts. NaN where position or pressure difference is missing;
/// a missing oil temperature is the one before, at the beginning the middle one of the edge's table.
[[nodiscard]] std::vector<double> edge_flow(const PassedEdges& edges, std::span<const double> position_m,
                                            std::span<const double> pressure_difference_Pa,
                                            std::span<const double> oil_temperature_K);

}  // namespace spoolflow::estimation

#pragma once
/// A place at which the valve works, and what its instruments would show there if the model were the truth.
#include <optional>
#include <vector>

#include "spoolflow/estimation/running_sensor.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/uncertainty/disturbed_sensor.hpp"

namespace spoolflow::uncertainty {

/// The spool passes `position_m` at a held pressure difference.
struct WorkingPoint {
  double position_m;
  double pressure_difference_Pa;
  double oil_temperature_K;
  bool opening = true;
};

/// The oil temperature at which the condensed sensor's flow-force map was measured; 50 C where that was not recorded.
[[nodiscard]] double map_temperature_K(const model::Model& model);

/// The coil current at which the condensed sensor's force balance holds, without friction; nothing where the point lies
/// outside its maps.
[[nodiscard]] std::optional<double> balanced_current_A(const model::Model& model, const WorkingPoint& point);

/// What the condensed sensor does not know at that point: the measured loops' half widths, and what warmer oil does.
[[nodiscard]] Surroundings surroundings_at(const model::Model& model, const WorkingPoint& point, double current_A);

/// How the oil's viscosity counts as temperature: dT/d ln(viscosity) [K], < 0, from two data-sheet viscosities after
/// Walther (ASTM D341); of a usual mineral oil where the model has none.
[[nodiscard]] double temperature_per_viscosity_K(const model::Fluid& fluid, double oil_temperature_K);

/// Samples that lead the observer to the point: the spool slides to it at a tenth of the stroke a second, friction
/// against it, and the coil carries the current that balances all forces. Nothing where the current leaves the map.
[[nodiscard]] std::optional<std::vector<estimation::TimedSample>> course_to(const model::Model& model,
                                                                            const WorkingPoint& point);

}  // namespace spoolflow::uncertainty

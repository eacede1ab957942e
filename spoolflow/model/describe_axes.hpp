#pragma once
/// The axes that tables share.
#include "spoolflow/model/parameter.hpp"

namespace spoolflow::model {

inline constexpr AxisParameter current_axis{"current_A", "A", {-1e3, 1e3}, 1e-4};
inline constexpr AxisParameter magnetising_current_axis{"magnetising_current_A", "A", {-1e3, 1e3}, 1e-4};
inline constexpr AxisParameter position_axis{"position_m", "m", {-0.1, 0.1}, 1e-7};
inline constexpr AxisParameter root_force_share_axis{"root_force_share", "1", {0, 1}, 1e-3};
inline constexpr AxisParameter oil_temperature_axis{"oil_temperature_K", "K", {200, 500}, 0.1};
inline constexpr AxisParameter pressure_difference_axis{"pressure_difference_Pa", "Pa", {0, 1e9}, 100};

}  // namespace spoolflow::model

#pragma once
/// What the residuals of a model are of, by the names that its file has, and where one of them stands.
#include <string_view>
#include <vector>

#include "spoolflow/model/model.hpp"

namespace spoolflow::model {

inline constexpr std::string_view of_spring_force = "spring force";
inline constexpr std::string_view of_magnetic_force = "magnetic force";
inline constexpr std::string_view of_axial_force = "axial force";
inline constexpr std::string_view of_flow_rate = "flow rate";

/// Throws ModelError, naming valve and residual, where `residuals` has none of that name: a residual that nobody knows
/// must not pass for one of zero.
[[nodiscard]] const Residual& residual_of(const Model& model, const std::vector<Residual>& residuals,
                                          std::string_view of);

}  // namespace spoolflow::model

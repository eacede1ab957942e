#pragma once
/// Distributions of errors, and the quantiles that an uncertainty budget needs.
#include <string_view>

namespace spoolflow::uncertainty {

/// All symmetric about zero. `rectangular`: anywhere between limits; `two_point`: at one of the limits, as friction of
/// unknown direction is.
enum class Distribution { normal, rectangular, two_point };
[[nodiscard]] std::string_view name(Distribution distribution);

/// Standard deviation over half width, for distributions that have limits; of a normal one the half width is that of a
/// 95 % statement.
[[nodiscard]] double deviation_per_half_width(Distribution distribution);

/// The value, in standard deviations, that a share `probability` in (0, 1) of all errors does not exceed.
[[nodiscard]] double quantile(Distribution distribution, double probability);

/// Standard normal; `probability` in (0, 1).
[[nodiscard]] double normal_quantile(double probability);
/// Share of a standard normal below `value`.
[[nodiscard]] double normal_share_below(double value);

/// k such that 95 % of Student's t lie within -k to k (JCGM 100, table G.2). `degrees_of_freedom` >= 1, infinity
/// allowed.
[[nodiscard]] double coverage_factor_95(double degrees_of_freedom);

}  // namespace spoolflow::uncertainty

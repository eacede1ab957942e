#pragma once
/// How the error depends on where the valve works: binned percentiles of its magnitude.
#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace spoolflow::validation {

/// What the error is looked at over.
enum class Quantity { flow, position, pressure_difference, oil_temperature };
inline constexpr std::array quantities{Quantity::flow, Quantity::position, Quantity::pressure_difference,
                                       Quantity::oil_temperature};

struct ProfileBin {
  double from, to;  ///< of the quantity, SI
  std::size_t samples;
  double median_m3_per_s, p95_m3_per_s;  ///< of the error's magnitude
  double band_coverage;                  ///< share of the samples inside the 95 % band
};

/// A share of the samples has errors of at most this magnitude.
struct DistributionPoint {
  double error_m3_per_s, share;
};

/// Collects errors in equal stretches of a quantity, in memory that does not grow with the samples. Percentiles are
/// true to 0.05 % of full scale; magnitudes beyond full scale count as full scale.
class ErrorProfile {
 public:
  ErrorProfile(double bin_width, double full_scale_m3_per_s, double origin = 0);
  /// NaN is left out.
  void add(double quantity, double error_m3_per_s, bool inside_band = false);
  void append(const ErrorProfile& others);
  /// In rising order; bins with less than a thousandth of all samples, or less than 20, are left out.
  [[nodiscard]] std::vector<ProfileBin> bins() const;
  /// Over all bins: from nothing to every sample, in steps of at least a two-hundredth of the samples.
  [[nodiscard]] std::vector<DistributionPoint> distribution() const;

 private:
  static constexpr std::size_t cells = 2000;
  struct Magnitudes {
    std::array<std::uint32_t, cells> count{};
    std::size_t samples = 0, inside = 0;
  };
  [[nodiscard]] double percentile(const Magnitudes& magnitudes, double share) const;

  double bin_width_, full_scale_m3_per_s_, origin_;
  std::map<int, Magnitudes> bins_;
  std::size_t samples_ = 0;
};

}  // namespace spoolflow::validation

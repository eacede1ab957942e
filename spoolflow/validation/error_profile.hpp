#pragma once
/// How the error depends on where the valve works: binned percentiles of its magnitude.
#include <array>
#include <cstdint>
#include <map>
#include <optional>
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

/// How the error differs between an opening and a closing spool: what is left of hysteresis and friction.
enum class Direction { opening, closing, rest };
inline constexpr std::array directions{Direction::opening, Direction::closing, Direction::rest};

/// Mean errors at a stretch of the position.
struct DirectionBin {
  double from_m, to_m;
  double opening_m3_per_s, closing_m3_per_s;
};

/// The largest difference between opening and closing at one position.
struct Hysteresis {
  double difference_m3_per_s;  ///< of the mean errors, opening less closing
  double position_m;
};

class DirectionProfile {
 public:
  struct Sizes {
    double stroke_m, full_scale_m3_per_s;
    bool whole_valve = false;  ///< positions from -stroke_m, else from 0
  };
  explicit DirectionProfile(const Sizes& sizes);
  /// NaN is left out.
  void add(Direction direction, double position_m, double error_m3_per_s);
  void append(const DirectionProfile& others);

  /// Percentiles of the error's magnitude; absent with less than 20 samples.
  [[nodiscard]] std::optional<ProfileBin> magnitudes(Direction direction) const;
  /// Positions at which both directions have at least 20 samples, in rising order.
  [[nodiscard]] std::vector<DirectionBin> bins() const;
  [[nodiscard]] std::optional<Hysteresis> hysteresis() const;

 private:
  static constexpr std::size_t positions = 24;  ///< each side
  struct Sum {
    double error_m3_per_s = 0;
    std::size_t samples = 0;
  };
  double stroke_m_, lowest_m_;
  ErrorProfile magnitudes_;                               ///< over the direction's number
  std::array<std::array<Sum, 2 * positions>, 2> sums_{};  ///< from lowest_m_ on
};

}  // namespace spoolflow::validation

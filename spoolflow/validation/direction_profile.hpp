#pragma once
/// How the error differs between an opening and a closing spool: what is left of hysteresis and friction.
#include <array>
#include <optional>
#include <vector>

#include "spoolflow/validation/error_profile.hpp"

namespace spoolflow::validation {

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

#pragma once
#include <cstdint>
#include <vector>

namespace spoolflow::analysis {

/// The first points of a Sobol sequence in (0, 1)^d, scrambled after Owen (1995): every digit is flipped or not by a
/// hash of seed, dimension and the digits before it. Direction numbers of Joe and Kuo (2008), from Boost. Evenly spread
/// best where the number of points is a power of two.
class SobolPoints {
 public:
  struct Extent {
    unsigned dimensions;  ///< 1 to 3667
    std::uint32_t points;
  };
  SobolPoints(const Extent& extent, std::uint64_t seed);

  struct Place {
    std::uint32_t point;
    unsigned dimension;
  };
  [[nodiscard]] double operator[](const Place& place) const {
    return values_[static_cast<std::size_t>(place.point) * dimensions_ + place.dimension];
  }

 private:
  unsigned dimensions_;
  std::vector<double> values_;  ///< point after point
};

}  // namespace spoolflow::analysis

#pragma once
/// Variance-based global sensitivity: what share of an output's variance each factor makes, alone and together with the
/// others. Sampling after Saltelli (2002) on a scrambled Sobol sequence; first-order indices after Saltelli et al.
/// (2010, table 2 b), total indices after Jansen (1999).
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

/// Which points to evaluate. A factor may be a group of numbers that change together; its index is that of the group.
/// Of `base_samples` rows each has points A, B and, for every factor, A with that factor's numbers from B.
class SaltelliDesign {
 public:
  /// `numbers_per_factor`: how many numbers each factor holds, >= 1.
  SaltelliDesign(std::vector<unsigned> numbers_per_factor, std::uint32_t base_samples, std::uint64_t seed);

  [[nodiscard]] std::size_t factors() const { return first_number_.size() - 1; }
  [[nodiscard]] std::size_t points_per_row() const { return factors() + 2; }
  /// Of all rows.
  [[nodiscard]] std::size_t points() const { return points_per_row() * base_samples_; }
  /// All numbers of point `index`, uniform over (0, 1): factor after factor.
  [[nodiscard]] std::vector<double> point(std::size_t index) const;

 private:
  std::vector<unsigned> first_number_;  ///< of each factor, and one past the last
  std::uint32_t base_samples_;
  SobolPoints points_;
};

/// An estimate with its 95 % confidence interval.
struct Index {
  double value, lower, upper;
};

struct FactorIndices {
  Index first_order;  ///< share of the variance that goes where the factor alone is fixed
  Index total;        ///< share that stays where all others are fixed
};

struct SobolIndices {
  double mean, standard_deviation;  ///< of the output
  std::vector<FactorIndices> factors;
};

/// `outputs` in the order of the design's points. Intervals from `resamples` bootstraps over the rows, with that seed.
/// An output that does not vary has indices of zero.
[[nodiscard]] SobolIndices sobol_indices(const SaltelliDesign& design, const std::vector<double>& outputs,
                                         std::uint64_t seed, int resamples = 1000);

}  // namespace spoolflow::analysis

#include "spoolflow/analysis/sobol_indices.hpp"

#include <algorithm>
#include <cmath>

#include <boost/random/sobol.hpp>

#include "spoolflow/uncertainty/seeded_numbers.hpp"

namespace spoolflow::analysis {

namespace {

constexpr int digits = 32;

/// Nested uniform scrambling of one coordinate: the digit at `place` is flipped by a hash of those before it.
std::uint32_t scrambled(std::uint32_t x, std::uint64_t key) {
  std::uint32_t flips = 0;
  for (int place = 0; place < digits; ++place) {
    const std::uint64_t before = place == 0 ? 0 : x >> (digits - place);
    const std::uint64_t level = (std::uint64_t{1} << (place + 24)) | before;  // one key for each prefix of each length
    if ((uncertainty::mixed_bits(key ^ uncertainty::mixed_bits(level)) >> 63U) != 0)
      flips |= std::uint32_t{1} << (digits - 1 - place);
  }
  return x ^ flips;
}

}  // namespace

SobolPoints::SobolPoints(const Extent& extent, std::uint64_t seed) : dimensions_(extent.dimensions) {
  boost::random::sobol_engine<std::uint32_t, digits> engine(extent.dimensions);
  values_.reserve(static_cast<std::size_t>(extent.points) * extent.dimensions);
  for (std::uint32_t point = 0; point < extent.points; ++point) {
    for (unsigned d = 0; d < extent.dimensions; ++d) {
      const std::uint32_t x = point == 0 ? 0 : engine();  // Boost leaves out the origin, which belongs to the sequence
      const std::uint64_t key = uncertainty::mixed_bits(seed + uncertainty::mixed_bits(d + 1));
      values_.push_back((static_cast<double>(scrambled(x, key)) + 0.5) * 0x1p-32);
    }
  }
}

namespace {

std::vector<unsigned> running_sums(const std::vector<unsigned>& counts) {
  std::vector<unsigned> sums{0};
  for (const unsigned count : counts) sums.push_back(sums.back() + count);
  return sums;
}

/// The outputs of one row of the design: A, B, then A with each factor from B.
using Row = const double*;

struct Moments {
  double mean, variance;
};

/// Of A and B together.
Moments moments_of(const std::vector<Row>& rows) {
  const double n = 2 * static_cast<double>(rows.size());
  double mean = 0;
  for (const Row row : rows) mean += (row[0] + row[1]) / n;
  double variance = 0;
  for (const Row row : rows) variance += ((row[0] - mean) * (row[0] - mean) + (row[1] - mean) * (row[1] - mean)) / n;
  return {mean, variance};
}

struct Shares {
  double first_order, total;
};

Shares shares_of(const std::vector<Row>& rows, std::size_t factor, const Moments& moments) {
  if (!(moments.variance > 0)) return {0, 0};
  double first = 0;
  double total = 0;
  for (const Row row : rows) {
    const double change = row[2 + factor] - row[0];
    first += (row[1] - moments.mean) * change;
    total += 0.5 * change * change;
  }
  const double scale = 1 / (static_cast<double>(rows.size()) * moments.variance);
  return {first * scale, total * scale};
}

Index with_interval(double value, std::vector<double>& resampled) {
  std::sort(resampled.begin(), resampled.end());
  const auto at = [&](double share) {
    return resampled[static_cast<std::size_t>(std::lround(share * static_cast<double>(resampled.size() - 1)))];
  };
  return {value, at(0.025), at(0.975)};
}

}  // namespace

SaltelliDesign::SaltelliDesign(std::vector<unsigned> numbers_per_factor, std::uint32_t base_samples, std::uint64_t seed)
    : first_number_(running_sums(numbers_per_factor)),
      base_samples_(base_samples),
      points_({.dimensions = 2 * first_number_.back(), .points = base_samples}, seed) {}

std::vector<double> SaltelliDesign::point(std::size_t index) const {
  const auto row = static_cast<std::uint32_t>(index / points_per_row());
  const std::size_t kind = index % points_per_row();
  const unsigned numbers = first_number_.back();
  const bool all_from_b = kind == 1;
  const unsigned from = kind < 2 ? 0 : first_number_[kind - 2];
  const unsigned until = kind < 2 ? 0 : first_number_[kind - 1];
  std::vector<double> out(numbers);
  for (unsigned k = 0; k < numbers; ++k) {
    const bool from_b = all_from_b || (k >= from && k < until);
    out[k] = points_[{row, from_b ? numbers + k : k}];
  }
  return out;
}

SobolIndices sobol_indices(const SaltelliDesign& design, const std::vector<double>& outputs, std::uint64_t seed,
                           int resamples) {
  const std::size_t factors = design.factors();
  std::vector<Row> rows;
  for (std::size_t k = 0; k < outputs.size(); k += design.points_per_row()) rows.push_back(&outputs[k]);

  std::vector<std::vector<double>> first(factors), total(factors);
  for (int resample = 0; resample < resamples; ++resample) {
    uncertainty::SeededNumbers numbers(seed, "bootstrap of Sobol indices", static_cast<std::uint64_t>(resample));
    std::vector<Row> drawn;
    for (std::size_t k = 0; k < rows.size(); ++k) drawn.push_back(rows[numbers.below(rows.size())]);
    const Moments moments = moments_of(drawn);
    for (std::size_t f = 0; f < factors; ++f) {
      const Shares shares = shares_of(drawn, f, moments);
      first[f].push_back(shares.first_order);
      total[f].push_back(shares.total);
    }
  }

  const Moments moments = moments_of(rows);
  SobolIndices out{moments.mean, std::sqrt(moments.variance), {}};
  for (std::size_t f = 0; f < factors; ++f) {
    const Shares shares = shares_of(rows, f, moments);
    out.factors.push_back({with_interval(shares.first_order, first[f]), with_interval(shares.total, total[f])});
  }
  return out;
}

}  // namespace spoolflow::analysis

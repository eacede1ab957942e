#include "spoolflow/analysis/sobol_sequence.hpp"

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

}  // namespace spoolflow::analysis

/// The rig's Preisach iron on measured loops of a MnZn ferrite (R. Szewczyk, JAmodel): its parameters were searched for
/// at random once; here the field strength that they ask for is held against the measured one.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "public_data.hpp"
#include "spoolflow/rig/plant/magnetic_hysteresis.hpp"

namespace spoolflow::rig {
namespace {

struct FerriteLoop {
  std::vector<double> field_A_per_m, density_T;
};

Iron ferrite() {
  return iron_of<double>(
      {.relative_permeability = 2000, .saturation_T = 1.10, .knee_width_T = 0.06},
      {.kind = HysteresisKind::preisach,
       .coercive_field_A_per_m = 37.4,
       .jiles_atherton = {},
       .preisach = {.reversible_share = 0.228, .coercive_spread = 1.0, .interaction_field_A_per_m = 19.5}});
}

/// RMS deviation over the loop's peak. The flux density is given; the measured slope turns a deviation of the field
/// strength into one of the flux density.
double ferrite_deviation_share(const FerriteLoop& loop) {
  const Iron iron = ferrite();
  IronMemory memory;
  const std::size_t count = loop.density_T.size();
  double sum = 0, compared = 0, peak_T = 0;
  for (std::size_t n = 0; n < 2 * count; ++n) {  // once round uncounted
    const std::size_t k = n % count;
    static_cast<void>(magnetise(iron, memory, loop.density_T[k]));
    const std::size_t before = k < 3 ? 0 : k - 3, after = std::min(k + 3, count - 1);
    const double field = std::abs(loop.field_A_per_m[after] - loop.field_A_per_m[before]);
    const double density = std::abs(loop.density_T[after] - loop.density_T[before]);
    if (n < count || !(field > 0)) continue;
    const double deviation_T = (memory.field_A_per_m - loop.field_A_per_m[k]) * density / field;
    sum += deviation_T * deviation_T;
    ++compared;
    peak_T = std::max(peak_T, std::abs(loop.density_T[k]));
  }
  return std::sqrt(sum / compared) / peak_T;
}

struct FerriteLoops : public_data::PublicData {
  FerriteLoops() : PublicData("steel-loops-jamodel") {}
};

TEST_F(FerriteLoops, TheRigsRelaysRunAlongThem) {
  const auto read = public_data::columns(data / "MnZn_HP_ferrite.csv", {"loop", "H_A_per_m", "B_T"});
  std::vector<FerriteLoop> loops(4);
  for (std::size_t k = 0; k < read[0].size(); ++k) {
    FerriteLoop& loop = loops.at(static_cast<std::size_t>(read[0][k]) - 1);
    loop.field_A_per_m.push_back(read[1][k]);
    loop.density_T.push_back(read[2][k]);
  }
  for (std::size_t k = 0; k < loops.size(); ++k) {
    fmt::print("  loop {}: RMS deviation {:.2f} % of its peak\n", k + 1, 100 * ferrite_deviation_share(loops[k]));
  }
  // Two of the four amplitudes closely, the others in size and shape: one spread of coercive fields serves them all.
  EXPECT_LT(ferrite_deviation_share(loops[0]), 0.03);
  EXPECT_LT(ferrite_deviation_share(loops[2]), 0.03);
  EXPECT_LT(ferrite_deviation_share(loops[1]), 0.09);
  EXPECT_LT(ferrite_deviation_share(loops[3]), 0.09);
}

}  // namespace
}  // namespace spoolflow::rig

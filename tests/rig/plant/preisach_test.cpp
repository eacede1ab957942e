#include "spoolflow/rig/plant/preisach.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace spoolflow::rig {
namespace {

constexpr double relay_coercive_A_per_m = 110.0;

/// Iron driven to flux densities, in small steps.
struct RelaySteel {
  PreisachIron iron = preisach_iron({}, {}, relay_coercive_A_per_m);
  PreisachMemory memory{};

  double to(double target_T, int steps = 50) {
    const double from_T = memory.now.flux_density_T;
    for (int i = 1; i <= steps; ++i) {
      magnetise(iron, memory, i == steps ? target_T : from_T + (target_T - from_T) * i / steps);
    }
    return memory.now.field_A_per_m;
  }
};

/// The same iron as relays one by one: each with its coercive and its interaction field, and no formula of Everett's.
class RelayByRelay {
 public:
  explicit RelayByRelay(const PreisachIron& iron) : iron_(iron) {
    for (int u = 0; u < interaction_count; ++u) {  // dense about zero, out to some 40 kA/m
      const auto at = [](double place) { return 500 * std::sinh(10 * (place / interaction_count - 0.5)); };
      const double slope = preisach::relays_at(iron, at(u + 0.5)).slope_H_per_m;
      interaction_A_per_m_.push_back(at(u + 0.5));
      weight_T_.push_back(0.5 * (1 - iron.reversible) / coercive_count * slope * (at(u + 1.0) - at(u)));
    }
    for (int c = 0; c < coercive_count; ++c) {
      coercive_A_per_m_.push_back(iron.least_coercive_A_per_m +
                                  (iron.most_coercive_A_per_m - iron.least_coercive_A_per_m) * (c + 0.5) /
                                      coercive_count);
      for (const double interaction : interaction_A_per_m_) up_.push_back(interaction < 0);  // demagnetised
    }
  }
  double flux_density_T(double field_A_per_m) {
    double sum_T = preisach::reversible_T(iron_, field_A_per_m);
    auto up = up_.begin();
    for (const double coercive : coercive_A_per_m_) {
      for (std::size_t u = 0; u < interaction_A_per_m_.size(); ++u, ++up) {
        // A relay switches up at h_u + h_c and down at h_u - h_c.
        if (field_A_per_m >= interaction_A_per_m_[u] + coercive) *up = true;
        if (field_A_per_m <= interaction_A_per_m_[u] - coercive) *up = false;
        sum_T += *up ? weight_T_[u] : -weight_T_[u];
      }
    }
    return sum_T;
  }

 private:
  static constexpr int coercive_count = 40, interaction_count = 1200;
  PreisachIron iron_;
  std::vector<double> coercive_A_per_m_, interaction_A_per_m_, weight_T_;
  std::vector<bool> up_;
};

TEST(RigPreisach, TheClosedFormIsTheSumOfItsRelays) {
  RelaySteel closed;
  RelayByRelay relays(closed.iron);
  for (const double target_T : {1.1, -0.4, 0.7, 0.2, 0.5, -1.6, 1.3, 0.0}) {
    const double from_T = closed.memory.now.flux_density_T;
    for (int i = 1; i <= 40; ++i) {
      const double field_A_per_m = closed.to(from_T + (target_T - from_T) * i / 40, 1);
      EXPECT_NEAR(relays.flux_density_T(field_A_per_m), closed.memory.now.flux_density_T, 6e-3) << target_T;
    }
  }
}

TEST(RigPreisach, MinorLoopsCloseAtTheirCorners) {
  RelaySteel iron;
  iron.to(1.5);
  const double outer = iron.to(0.3);
  const double inner = iron.to(0.8);
  iron.to(0.5);
  EXPECT_NEAR(iron.to(0.8), inner, 1e-6);
  EXPECT_NEAR(iron.to(0.3), outer, 1e-6);
  EXPECT_EQ(iron.memory.count, 1U);  // as if neither loop had ever been: the reversal at 1.5 T alone
}

TEST(RigPreisach, LargerExcursionsWipeOutSmallerOnes) {
  RelaySteel straight, detour;
  straight.to(1.5);
  for (const double turn_T : {0.5, 0.2, 0.4, 0.3}) detour.to(turn_T);
  EXPECT_NEAR(detour.to(1.5), straight.memory.now.field_A_per_m, 1e-6);
  EXPECT_EQ(detour.memory.count, 0U);  // the virgin curve again
  detour.to(-0.3);
  straight.to(-1.7);
  EXPECT_NEAR(detour.to(-1.7), straight.memory.now.field_A_per_m, 1e-6);
}

TEST(RigPreisach, LoopsBetweenTheSameFieldsAreCongruent) {
  // Seek the flux densities at which a branch passes a field, then compare the loops' heights.
  const auto flux_at = [](RelaySteel& iron, double field_A_per_m, double towards_T) {
    while ((field_A_per_m - iron.memory.now.field_A_per_m) * towards_T > 0) {
      iron.to(iron.memory.now.flux_density_T + towards_T * 1e-5, 1);
    }
    return iron.memory.now.flux_density_T;
  };
  std::vector<double> heights;
  for (const double before_T : {1.6, -1.6}) {
    RelaySteel iron;
    iron.to(before_T);
    if (before_T > 0) flux_at(iron, 0, -1);
    const double low = flux_at(iron, 0, 1);
    heights.push_back(flux_at(iron, 150, 1) - low);
    heights.back() = iron.memory.now.flux_density_T - flux_at(iron, 0, -1);
  }
  EXPECT_NEAR(heights[0], heights[1], 1e-4);
}

TEST(RigPreisach, SmallLoopsFollowRayleigh) {
  // Relays down to no coercive field at all: the loss grows with the third power of the amplitude.
  const auto loss = [](double peak_A_per_m) {
    RelaySteel iron;
    double sum = 0;
    const auto drive = [&](double field_A_per_m) {
      while (std::abs(field_A_per_m - iron.memory.now.field_A_per_m) > 1e-2) {
        const ReversalPoint before = iron.memory.now;
        const double step_A_per_m = std::clamp(field_A_per_m - before.field_A_per_m, -0.02, 0.02);
        iron.to(before.flux_density_T + 2e-4 * step_A_per_m, 1);
        sum += 0.5 * (before.field_A_per_m + iron.memory.now.field_A_per_m) *
               (iron.memory.now.flux_density_T - before.flux_density_T);
      }
    };
    drive(peak_A_per_m);
    sum = 0;
    drive(-peak_A_per_m);
    drive(peak_A_per_m);
    return sum;
  };
  EXPECT_NEAR(loss(20) / loss(10), 8.0, 0.3);
}

TEST(RigPreisach, ForgetsTheInnermostLoopsWhereTooManyAreNested) {
  RelaySteel many;
  double swing_T = 1.0;
  for (int turn = 0; turn < 500; ++turn) {
    swing_T *= -0.985;
    const double before = many.memory.now.field_A_per_m;
    const double change_T = swing_T - many.memory.now.flux_density_T;
    EXPECT_GT((many.to(swing_T) - before) * change_T, 0) << turn;
    ASSERT_LE(many.memory.count, remembered_reversals);
  }
  RelaySteel direct;
  direct.to(1.5);
  EXPECT_NEAR(many.to(1.5), direct.memory.now.field_A_per_m, 1e-6);  // the large ones are remembered
}

}  // namespace
}  // namespace spoolflow::rig

/// The sensor's magnetic hysteresis on measured loops of grain-oriented steel M130-27s (R. Szewczyk, JAmodel).
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "public_data.hpp"
#include "spoolflow/calibration/fits/hysteresis_loops.hpp"
#include "spoolflow/numerics/crossing.hpp"

namespace spoolflow::calibration {
namespace {

/// One closed loop: field strength [A/m] over flux density [T], point by point.
struct Loop {
  std::vector<double> field_A_per_m, density_T;
};

/// The anhysteretic curve: odd, convex above zero, a ramp from each knot on.
constexpr int knots = 24;
double ramp(int knot, double density_T, double full_T) {
  const double reach = std::abs(density_T) - full_T * knot / knots;
  return std::copysign(std::max(reach, 0.0), density_T);
}

/// A loop run through twice: from the demagnetised state into the loop, uncounted, then counted.
HysteresisHistory history_of(const Loop& loop, double full_T) {
  HysteresisHistory out;
  out.companions.resize(knots);
  const std::size_t count = loop.density_T.size();
  for (std::size_t n = 0; n < 2 * count; ++n) {
    const std::size_t k = n % count;
    const std::size_t before = k < 3 ? 0 : k - 3;
    const std::size_t after = std::min(k + 3, count - 1);
    const double field = std::abs(loop.field_A_per_m[after] - loop.field_A_per_m[before]);
    const double density = std::abs(loop.density_T[after] - loop.density_T[before]);
    out.flux.push_back(loop.density_T[k]);
    out.output.push_back(loop.field_A_per_m[k]);
    // The slope turns a deviation of the field strength into one of the flux density.
    out.weight.push_back(n < count || !(field > 0) ? 0.0 : density / field);
    for (int knot = 0; knot < knots; ++knot)
      out.companions[static_cast<std::size_t>(knot)].push_back(ramp(knot, loop.density_T[k], full_T));
  }
  return out;
}

/// The steel as identified: asks for a field strength at each flux density, given its memory.
struct Steel {
  HysteresisFit fit;
  double full_T;

  double anhysteretic_A_per_m(double density_T) const {
    double field = 0;
    for (int knot = 0; knot < knots; ++knot)
      field += fit.companion_shares[static_cast<std::size_t>(knot)] * ramp(knot, density_T, full_T);
    return field;
  }
  /// Flux density at a field strength, by bisection: both parts rise with it.
  double density_T(const sensor::HysteresisState<double>& state, double field_A_per_m) const {
    return numerics::crossing({-2 * full_T, 2 * full_T}, field_A_per_m, [&](double density) {
      return anhysteretic_A_per_m(density) + hysteresis_at(fit.hysteresis, state, density).value;
    });
  }
};

Steel identify(std::initializer_list<const Loop*> loops) {
  double full_T = 0;
  for (const Loop* loop : loops)
    for (const double density : loop->density_T) full_T = std::max(full_T, std::abs(density));
  std::vector<HysteresisHistory> histories;
  for (const Loop* loop : loops) histories.push_back(history_of(*loop, full_T));
  return {fit_hysteresis(histories), full_T};
}

/// RMS deviation of the predicted flux density over the loop's peak. Only the field strength is given.
double deviation_share(const Steel& steel, const Loop& loop) {
  sensor::HysteresisState<double> state;
  double sum = 0;
  double peak = 0;
  const std::size_t count = loop.density_T.size();
  for (std::size_t n = 0; n < 2 * count; ++n) {
    const double density = steel.density_T(state, loop.field_A_per_m[n % count]);
    sensor::advance(steel.fit.hysteresis, state, density);
    if (n < count) continue;
    const double measured = loop.density_T[n - count];
    sum += (density - measured) * (density - measured);
    peak = std::max(peak, std::abs(measured));
  }
  return std::sqrt(sum / static_cast<double>(count)) / peak;
}

/// What remains with no memory at all.
Steel without_hysteresis(std::initializer_list<const Loop*> loops) {
  Steel steel = identify(loops);
  steel.fit.hysteresis.stiffness.fill(0);
  steel.fit.hysteresis.stiffness_increase.fill(0);
  return steel;
}

struct SteelLoops : public_data::PublicData {
  SteelLoops() : PublicData("steel-loops-jamodel") {}

  Loop loop(int number) const {
    const auto read = public_data::columns(data / "M130_27s.csv", {"loop", "H_A_per_m", "B_T"});
    Loop out;
    for (std::size_t k = 0; k < read[0].size(); ++k) {
      if (read[0][k] != number) continue;
      out.field_A_per_m.push_back(read[1][k]);
      out.density_T.push_back(read[2][k]);
    }
    return out;
  }
};

TEST_F(SteelLoops, TheMiddleLoopIsForetoldFromTheOthers) {
  const Loop inner = loop(1), middle = loop(2), outer = loop(3);
  const Steel steel = identify({&inner, &outer});
  const double predicted = deviation_share(steel, middle);
  const double anhysteretic = deviation_share(without_hysteresis({&inner, &outer}), middle);
  fmt::print("  loop 2 from loops 1 and 3: RMS deviation {:.2f} % of its peak, anhysteretic curve alone {:.1f} %\n",
             100 * predicted, 100 * anhysteretic);
  fmt::print("  loops 1 and 3 themselves: {:.2f} and {:.2f} %\n", 100 * deviation_share(steel, inner),
             100 * deviation_share(steel, outer));
  EXPECT_LT(predicted, 0.06);
  EXPECT_GT(anhysteretic, 0.18);
}

}  // namespace
}  // namespace spoolflow::calibration

#include "spoolflow/plausibility/signals/induced_delay.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "spoolflow/plausibility/signals/coil_blocks.hpp"

namespace spoolflow::plausibility {
namespace {

constexpr std::ptrdiff_t earliest_usual = -4, latest_usual = 3;  ///< blocks; sound runs have -8 to 6 ms
constexpr double latest_s = 0.0095, earliest_s = -0.0155;
constexpr double most_left = 0.9;          ///< of what a usual shift leaves: what shakes all along fits at many
constexpr std::ptrdiff_t most_shift = 75;  ///< blocks
constexpr std::ptrdiff_t margin = 2;       ///< of rates, on either side
constexpr double fast_strokes_per_s = 0.5, fewest_fast = 500;
constexpr double step_A = 0.01, step_m = 1e-5;  ///< of the flux linkage's derivatives

/// One block: what its coil has beside the resistance, and what current and motion induce in it.
struct Induced {
  double voltage_V, by_current_V, per_speed_Vs_per_m;
  std::size_t block;
};

/// Blocks within `most_shift` of a fast one, each once; those of a gap are left out.
std::vector<std::size_t> about_motion(const std::vector<double>& speed_m_per_s, double fast_m_per_s) {
  std::vector<std::size_t> out;
  const auto size = static_cast<std::ptrdiff_t>(speed_m_per_s.size());
  std::ptrdiff_t fast = -1 - most_shift, broken = -1 - most_shift;
  std::ptrdiff_t ahead = 0;  // looks at the block that comes into reach
  for (std::ptrdiff_t k = 0; k + most_shift < size; ++k) {
    for (; ahead <= k + most_shift; ++ahead) {
      const double speed = speed_m_per_s[static_cast<std::size_t>(ahead)];
      if (std::isnan(speed)) broken = ahead;
      if (std::abs(speed) > fast_m_per_s) fast = ahead;
    }
    if (k >= most_shift && fast >= k - most_shift && broken < k - most_shift)
      out.push_back(static_cast<std::size_t>(k));
  }
  return out;
}

/// What motion `shift` blocks later leaves of the voltage, as a share of its square.
double left_over(const std::vector<Induced>& all, const std::vector<double>& speed_m_per_s, std::ptrdiff_t shift) {
  double voltage2 = 0, both = 0, induced2 = 0;
  for (const Induced& each : all) {
    const auto moved = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(each.block) + shift);
    const double induced_V = each.by_current_V + each.per_speed_Vs_per_m * speed_m_per_s[moved];
    voltage2 += each.voltage_V * each.voltage_V;
    both += each.voltage_V * induced_V;
    induced2 += induced_V * induced_V;
  }
  return 1 - both * both / (voltage2 * induced2);
}

}  // namespace

std::optional<double> induced_delay_s(const MotionTrace& run, const KnownCoil& coil, double stroke_m) {
  if (!coil.flux_Wb) return std::nullopt;
  const std::vector<double> position_m = run.position_m(), current_A = run.current_A(), voltage_V = run.voltage_V();
  const double resistance_Ohm = resistance_Ohm_of(current_A, voltage_V);
  if (!std::isfinite(resistance_Ohm)) return std::nullopt;
  std::vector<double> speed_m_per_s(position_m.size(), std::nan(""));
  for (std::size_t k = margin; k + margin < position_m.size(); ++k)
    speed_m_per_s[k] = rate(position_m, k, MotionTrace::block_s);
  std::vector<Induced> all;
  for (const std::size_t k : about_motion(speed_m_per_s, fast_strokes_per_s * stroke_m)) {
    const double i = current_A[k], x = position_m[k];
    const double per_A = (coil.flux_Wb(i + step_A, x) - coil.flux_Wb(i - step_A, x)) / (2 * step_A);
    const double per_m = (coil.flux_Wb(i, x + step_m) - coil.flux_Wb(i, x - step_m)) / (2 * step_m);
    const Induced induced{induced_V(current_A, voltage_V, resistance_Ohm, k),
                          per_A * rate(current_A, k, MotionTrace::block_s), per_m, k};
    if (std::isfinite(induced.voltage_V + induced.by_current_V)) all.push_back(induced);
  }
  if (static_cast<double>(all.size()) < fewest_fast) return std::nullopt;
  std::ptrdiff_t best = 0;
  double least = 1, usual_least = 1;
  for (std::ptrdiff_t shift = -most_shift; shift <= most_shift; ++shift) {
    const double left = left_over(all, speed_m_per_s, shift);
    if (shift >= earliest_usual && shift <= latest_usual) usual_least = std::min(usual_least, left);
    if (left >= least) continue;
    least = left;
    best = shift;
  }
  const double late_s = static_cast<double>(best) * MotionTrace::block_s;
  const bool usual = late_s > earliest_s && late_s < latest_s;
  if (usual || !(least < most_left * usual_least)) return std::nullopt;
  return late_s;
}

}  // namespace spoolflow::plausibility

#include "spoolflow/plausibility/signals/clock_rate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/plausibility/signals/coil_blocks.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

constexpr double shortest_s = 0.05, longest_s = 0.26;  ///< of a mean: several time constants of eddy currents
constexpr double piece_s = 2;                          ///< within which copper keeps its temperature
constexpr double fewest_pieces = 5;
constexpr double least_share = 0.7, most_share = 1.6;  ///< of the induced voltage; sound runs have 0.89 to 1.34
constexpr double most_deviation = 0.025;               ///< of the share
constexpr double most_resistance_ratio = 1.35;

/// A coil's means, and its flux as the model has it.
struct CoilMean {
  double time_s, current_A, voltage_V, flux_Wb;
};

/// Over `shortest_s` at least, as long as the recording's own means allow.
std::vector<CoilMean> coil_means(const Recording& run, const KnownCoil& coil) {
  const std::vector<double>&time_s = run.column(Channel::time), &current_A = run.column(Channel::current),
        &voltage_V = run.column(Channel::voltage), &position_m = run.column(Channel::position);
  std::vector<CoilMean> out;
  for (std::size_t from = 0, k = 0; k < time_s.size(); ++k) {
    if (k + 1 < time_s.size() && time_s[k + 1] - time_s[from] < shortest_s) continue;
    CoilMean mean{0, 0, 0, 0};
    double position_sum_m = 0;
    const auto count = static_cast<double>(k + 1 - from);
    for (; from <= k; ++from) {
      mean.time_s += time_s[from] / count;
      mean.current_A += current_A[from] / count;
      mean.voltage_V += voltage_V[from] / count;
      position_sum_m += position_m[from] / count;
    }
    const bool known = std::isfinite(mean.current_A + position_sum_m);  // a table has its edge's value beside it
    mean.flux_Wb = known ? coil.flux_Wb(mean.current_A, position_sum_m) : std::nan("");
    out.push_back(mean);
  }
  return out;
}

/// Sums over one piece of time of current, induced voltage and voltage about their means.
class Piece {
 public:
  void take(double current_A, double induced_V, double voltage_V) {
    const std::array<double, 3> values{current_A, induced_V, voltage_V};
    ++count_;
    for (std::size_t a = 0; a < values.size(); ++a) {
      sums_[a] += values[a];
      for (std::size_t b = 0; b < values.size(); ++b) squares_[a][b] += values[a] * values[b];
    }
  }
  /// What the resistance does not explain: of two of current (0), induced voltage (1) and voltage (2).
  [[nodiscard]] double beside_resistance(std::size_t a, std::size_t b) const {
    const double current2 = about_means(0, 0);
    return about_means(a, b) - (current2 > 0 ? about_means(0, a) * about_means(0, b) / current2 : 0);
  }
  [[nodiscard]] double count() const { return count_; }

 private:
  [[nodiscard]] double about_means(std::size_t a, std::size_t b) const {
    return squares_[a][b] - sums_[a] * sums_[b] / count_;
  }
  double count_ = 0;
  std::array<double, 3> sums_{};
  std::array<std::array<double, 3>, 3> squares_{};
};

/// How much of the induced voltage the coil has, by least squares over all pieces.
struct InducedShare {
  double share = NAN, deviation = NAN, pieces = 0;
};

InducedShare induced_share(const std::vector<CoilMean>& means) {
  double induced2 = 0, both = 0, voltage2 = 0, count = 0, pieces = 0, from_s = means.front().time_s;
  Piece piece;
  const auto close = [&] {
    constexpr double fewest = 10;
    if (piece.count() >= fewest) {
      induced2 += piece.beside_resistance(1, 1);
      both += piece.beside_resistance(1, 2);
      voltage2 += piece.beside_resistance(2, 2);
      count += piece.count();
      ++pieces;
    }
    piece = {};
  };
  for (std::size_t k = 1; k + 1 < means.size(); ++k) {
    const CoilMean &before = means[k - 1], &now = means[k], &after = means[k + 1];
    if (now.time_s - from_s > piece_s) {
      close();
      from_s = now.time_s;
    }
    const double lasts_s = after.time_s - before.time_s;
    const double induced_V = (after.flux_Wb - before.flux_Wb) / lasts_s;
    if (lasts_s < 2 * longest_s && std::isfinite(induced_V + now.current_A + now.voltage_V))
      piece.take(now.current_A, induced_V, now.voltage_V);
  }
  close();
  if (!(induced2 > 0)) return {};
  const double share = both / induced2;
  return {share, std::sqrt(std::max(voltage2 - share * both, 0.0) / count / induced2), pieces};
}

/// Over that of the calibration, by the means of all currents.
double resistance_ratio(const std::vector<CoilMean>& means, double resistance_Ohm) {
  CoilResistance resistance;
  for (const CoilMean& mean : means) resistance.take(mean.current_A, mean.voltage_V);
  return resistance.Ohm() / resistance_Ohm;
}

}  // namespace

std::string wrong_clock(const Recording& run, const KnownCoil& coil) {
  if (!coil.flux_Wb || !(coil.resistance_Ohm > 0)) return {};
  for (const Channel channel : {Channel::time, Channel::current, Channel::voltage, Channel::position})
    if (!run.has(channel) || run.column(channel).size() < 2) return {};
  const std::vector<CoilMean> means = coil_means(run, coil);
  const double ratio = resistance_ratio(means, coil.resistance_Ohm);
  if (!(ratio < most_resistance_ratio && ratio > 1 / most_resistance_ratio)) return {};
  const InducedShare found = induced_share(means);
  if (found.pieces < fewest_pieces || !(found.deviation < most_deviation * found.share)) return {};
  if (found.share > least_share && found.share < most_share) return {};
  const bool fast = found.share < 1;
  return fmt::format(
      "time runs {:.1f} times too {}: beside its resistance the coil has {:.2f} times the voltage that its changing "
      "flux induces in the time recorded (sound runs have 0.9 to 1.3); look at the recorder's sample rate and the "
      "time's unit, and correct the time in the channel map",
      fast ? 1 / found.share : found.share, fast ? "fast" : "slow", found.share);
}

}  // namespace spoolflow::plausibility

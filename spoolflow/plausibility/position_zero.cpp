#include "spoolflow/plausibility/position_zero.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/LU>
#include <fmt/format.h>

#include "spoolflow/numerics/equations/symmetric_equations.hpp"
#include "spoolflow/numerics/median.hpp"
#include "spoolflow/plausibility/block_means.hpp"
#include "spoolflow/plausibility/limits.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;
using recording::Recording;

constexpr double least_open_Pa = 2e4;
constexpr double largest_step_m = 1e-4;  // of one round

struct OpenBlock {
  double time_s, position_m, root_Pa, flow;
};
std::vector<OpenBlock> open_blocks(const Recording& means) {
  std::vector<OpenBlock> out;
  const std::vector<double>& position_m = means.column(Channel::position);
  const std::vector<double>& pressure_Pa = means.column(Channel::pressure_difference);
  const std::vector<double>& flow = means.column(Channel::flow);
  if (position_m.empty() || pressure_Pa.empty() || flow.empty()) return out;
  for (std::size_t k = 0; k < flow.size(); ++k) {
    if (pressure_Pa[k] > least_open_Pa && std::isfinite(position_m[k] + flow[k]))
      out.push_back({means.column(Channel::time)[k], position_m[k], std::sqrt(pressure_Pa[k]), flow[k]});
  }
  return out;
}

/// One step of the least squares: flow = scale C(x - offset) sqrt(dp), less lag times its change, less slope times a
/// change of the offset.
struct OffsetStep {
  double count = 0, scale = 0, step_m = 0;
  double residual2 = 0, flow2 = 0;  ///< sums of squares; what scale and lag leave at this offset
  double flow_per_m = 0;            ///< mean
};
OffsetStep offset_step(const OpeningCurve& curve, const std::vector<OpenBlock>& blocks, double offset_m) {
  std::vector<double> expected(blocks.size()), slope(blocks.size());
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const auto [conductance, per_m] = curve.at(blocks[k].position_m - offset_m);
    expected[k] = conductance * blocks[k].root_Pa;
    slope[k] = per_m * blocks[k].root_Pa;
  }
  OffsetStep out;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < blocks.size(); ++k) {
    const double step_s = blocks[k + 1].time_s - blocks[k - 1].time_s;
    const Eigen::Vector3d row(expected[k], -(expected[k + 1] - expected[k - 1]) / step_s, -slope[k]);
    if (!row.allFinite()) continue;
    matrix += row * row.transpose();
    right += blocks[k].flow * row;
    out.flow2 += squared(blocks[k].flow);
    out.flow_per_m += slope[k];
    ++out.count;
  }
  if (!(matrix.diagonal().minCoeff() > 0)) return {};
  constexpr double least = 1e-4;  // of a column's square: what the others do not do as well
  const Eigen::Vector3d size = matrix.diagonal().cwiseSqrt();
  const Eigen::Matrix3d alike = size.cwiseInverse().asDiagonal() * matrix * size.cwiseInverse().asDiagonal();
  if (!(alike.determinant() > least)) return {};
  const Eigen::Vector3d with = numerics::solve_symmetric(matrix, right);
  const Eigen::Vector2d without = numerics::solve_symmetric(matrix.topLeftCorner<2, 2>(), right.head<2>());
  out.scale = with[0];
  out.step_m = with[2] / with[0];
  out.residual2 = std::max(out.flow2 - without.dot(right.head<2>()), 0.0);
  out.flow_per_m *= with[0] / out.count;
  return out;
}

}  // namespace

OpeningCurve::OpeningCurve(const std::vector<const Recording*>& recordings, double stroke_m) {
  constexpr int steps = 50, beyond = 5;
  struct Bin {
    double position_m = 0, product = 0, square = 0, count = 0;
  };
  std::vector<Bin> bins(steps + 2 * beyond);
  for (const Recording* recording : recordings) {
    for (const OpenBlock& block : open_blocks(*recording)) {
      const double place = std::floor(block.position_m / stroke_m * steps) + beyond;
      if (!(place >= 0) || place >= static_cast<double>(bins.size())) continue;
      Bin& bin = bins[static_cast<std::size_t>(place)];
      bin.position_m += block.position_m;
      bin.product += block.flow * block.root_Pa;
      bin.square += squared(block.root_Pa);
      ++bin.count;
    }
  }
  for (const Bin& bin : bins) {
    if (!(bin.count > 0)) continue;
    position_m_.push_back(bin.position_m / bin.count);
    conductance_.push_back(bin.product / bin.square);
  }
  if (position_m_.size() < 2) *this = {};
}

OpeningCurve::Point OpeningCurve::at(double position_m) const {
  if (empty() || !(position_m >= position_m_.front()) || !(position_m <= position_m_.back()))
    return {std::nan(""), std::nan("")};
  const auto above = std::ranges::upper_bound(position_m_.begin() + 1, position_m_.end() - 1, position_m);
  const auto k = static_cast<std::size_t>(above - position_m_.begin());
  const double slope = (conductance_[k] - conductance_[k - 1]) / (position_m_[k] - position_m_[k - 1]);
  return {conductance_[k - 1] + slope * (position_m - position_m_[k - 1]), slope};
}

double OpeningCurve::opens_at_m() const {
  constexpr double open_share = 0.02;
  if (empty()) return std::nan("");
  const double open = open_share * std::ranges::max(conductance_);
  std::size_t k = conductance_.size() - 1;
  while (k > 0 && conductance_[k - 1] > open) --k;
  if (k == 0) return std::nan("");
  const double share = (open - conductance_[k - 1]) / (conductance_[k] - conductance_[k - 1]);
  return position_m_[k - 1] + share * (position_m_[k] - position_m_[k - 1]);
}

std::optional<ZeroOffset> zero_offset(const OpeningCurve& curve, const Recording& means) {
  const std::vector<OpenBlock> blocks = open_blocks(means);
  double offset_m = 0, without = 0;
  constexpr int rounds = 8;
  for (int round = 0;; ++round) {
    const OffsetStep fit = offset_step(curve, blocks, offset_m);
    if (fit.count < least_blocks || !std::isfinite(fit.step_m) || !(fit.scale > 0)) return std::nullopt;
    if (round == 0) without = fit.residual2;
    if (round == rounds) {
      return ZeroOffset{offset_m, std::sqrt(fit.residual2 / without), std::sqrt(fit.residual2 / fit.flow2),
                        -fit.flow_per_m * offset_m};
    }
    offset_m += std::clamp(fit.step_m, -largest_step_m, largest_step_m);
  }
}

std::optional<ZeroOffset> misplaced_zero(const OpeningCurve& curve, const Recording& means, double stroke_m) {
  std::optional<ZeroOffset> out = zero_offset(curve, means);
  const bool explains = out && out->residual_share < most_zero_share && out->left_share < most_zero_residual;
  return explains && over_limit(*out, stroke_m) > 1 ? out : std::nullopt;
}

double over_limit(const ZeroOffset& offset, double stroke_m) {
  return std::abs(offset.offset_m) / (zero_share * stroke_m);
}

std::string shown(const ZeroOffset& offset, std::string_view than_where) {
  return fmt::format(
      "position reads {:.3f} mm {} than {}: where the edge opens and how the flow rises with it fit once it is shifted "
      "(leaving {:.0f} % of what flows leave as it is); the zero of the position sensor moved between the recordings, "
      "or "
      "the flow meter's is off by about {:.2g} L/min; measure the closed position, and give the position that offset "
      "in "
      "the channel map, or record it again",
      units::mm_from_m(std::abs(offset.offset_m)), offset.offset_m > 0 ? "more" : "less", than_where,
      100 * offset.residual_share, units::L_per_min_from_m3_per_s(offset.meter_offset_m3_per_s));
}

std::optional<double> rest_position(const Recording& means, const HydraulicCurves& hydraulics,
                                    double largest_current_A) {
  constexpr double no_current = 0.02, still_per_s = 0.01, preload_frictions = 1.3;
  constexpr std::size_t fewest = 10;
  if (!(hydraulics.spring_at(0) > preload_frictions * hydraulics.friction_N)) return std::nullopt;
  const Recording slow = longer_blocks(means);
  const std::vector<double>& position_m = slow.column(Channel::position);
  const std::vector<double> velocity = velocities(slow);
  std::vector<double> at_rest;
  const auto is_off = [&](Channel channel, std::size_t k) {
    return !slow.has(channel) || std::abs(slow.column(channel)[k]) < no_current * largest_current_A;
  };
  for (std::size_t k = 0; k < position_m.size(); ++k) {
    const bool off = is_off(Channel::current, k) && is_off(Channel::current_a, k) && is_off(Channel::current_b, k);
    if (off && std::abs(velocity[k]) < still_per_s * hydraulics.stroke_m && std::isfinite(position_m[k]))
      at_rest.push_back(position_m[k]);
  }
  if (at_rest.size() < fewest) return std::nullopt;
  return numerics::median(at_rest);
}

}  // namespace spoolflow::plausibility

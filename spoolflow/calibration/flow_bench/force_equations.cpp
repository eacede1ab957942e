#include "spoolflow/calibration/flow_bench/force_equations.hpp"

#include <algorithm>
#include <cmath>

#include "spoolflow/numerics/equations/symmetric_equations.hpp"
#include "spoolflow/numerics/median.hpp"

namespace spoolflow::calibration {
namespace {

using Row = std::vector<std::pair<int, double>>;

constexpr double usual_residual_N = 0.3;
/// Neighbouring samples share what the model omits, as a loop's path and a coil that warms, for seconds: so many of
/// them count as one. Counted as more, they draw all forces that the current makes towards none, which leaves no
/// residual.
constexpr double samples_alike = 1000;
/// Of what a force rig measured, at knots, the same.
constexpr double measured_alike = 30;

struct Equation {
  Row row;
  double right;
  double samples;  ///< of which it is the mean
};

/// Normal equations of rows of few entries.
class Equations {
 public:
  explicit Equations(int unknowns)
      : matrix_(Eigen::MatrixXd::Zero(unknowns, unknowns)), right_(Eigen::VectorXd::Zero(unknowns)) {}

  void add(const Row& row, double right, double deviation) {
    const double weight = 1 / (deviation * deviation);
    for (const auto& [r, of_r] : row) {
      for (const auto& [c, of_c] : row) matrix_(r, c) += weight * of_r * of_c;
      right_(r) += weight * of_r * right;
    }
  }
  [[nodiscard]] Eigen::MatrixXd inverse() const { return numerics::inverse_of_symmetric(matrix_); }
  [[nodiscard]] const Eigen::VectorXd& right() const { return right_; }

 private:
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_;
};

struct Layer {
  int lower;
  double share;
};

Layer layer_at(const ForceLayout& layout, double temperature_K, int edge) {
  const std::vector<double>& known = layout.temperatures_K;
  const int first = edge * layout.layers_of_edge();
  if (known.size() == 1 || std::isnan(temperature_K)) return {first, 0};
  std::size_t k = 0;
  while (k + 2 < known.size() && temperature_K > known[k + 1]) ++k;
  return {first + static_cast<int>(k), std::clamp((temperature_K - known[k]) / (known[k + 1] - known[k]), 0.0, 1.0)};
}

template <class At>
void add_layers(Row& row, const ForceLayout& layout, const Layer& layer, const Knots& knots, double x, double factor,
                const At& at) {
  const Knots::Place place = knots.at(x);
  for (int l = 0; l < std::min(2, layout.layers_of_edge()); ++l) {
    const double share = factor * (l == 0 ? 1 - layer.share : layer.share);
    if (share == 0) continue;
    row.emplace_back(at(layer.lower + l, place.lower), share * (1 - place.share));
    row.emplace_back(at(layer.lower + l, place.lower + 1), share * place.share);
  }
}

Equation equation_of(const ForceLayout& layout, const sensor::MagneticForce<double>& coenergy_force,
                     const RunForces& run, std::size_t k, const CoilSizes& at, const Eigen::VectorXd& before) {
  const SlidingSample& sample = (*run.samples)[k];
  const double current_A = run.magnetising_A[k], x = sample.position_m, dp_Pa = sample.pressure_difference_Pa;
  const auto force = coenergy_force.at(current_A, x);
  Equation out{{}, -force.value, 1};
  out.row.reserve(24);
  const Knots::Place i = layout.currents.at(current_A), p = layout.places.at(x);
  double corrected = 1;
  for (int r = 0; r < 2; ++r) {
    for (int c = 0; c < 2; ++c) {
      const int unknown = layout.map_at(i.lower + r, p.lower + c);
      const double share = (r == 0 ? 1 - i.share : i.share) * (c == 0 ? 1 - p.share : p.share);
      out.row.emplace_back(unknown, force.value * share);
      if (before.size() > 0) corrected += share * before(unknown);
    }
  }
  const Knots::Place s = layout.spring.at(x);
  out.row.emplace_back(layout.spring_at(s.lower), -(1 - s.share));
  out.row.emplace_back(layout.spring_at(s.lower + 1), -s.share);
  const Layer layer = layer_at(layout, run.run->oil_temperature_K, run.run->edge);
  const double d = sample.direction;
  if (!run.armature_friction_N.empty()) out.right += d * run.armature_friction_N[k];
  const auto force_at = [&](int l, int n) { return layout.force_at(l, n); };
  const auto dry_at = [&](int l, int n) { return layout.dry_at(l, n); };
  const auto loaded_at = [&](int l, int n) { return layout.loaded_at(l, n); };
  if (dp_Pa != 0) add_layers(out.row, layout, layer, layout.force, x, -1e-5 * dp_Pa, force_at);
  add_layers(out.row, layout, layer, layout.dry, x, -d, dry_at);
  if (dp_Pa != 0) add_layers(out.row, layout, layer, layout.loaded, x, -d * 1e-5 * dp_Pa, loaded_at);
  out.row.emplace_back(layout.mass(), -sample.acceleration_m_per_s2);
  for (int n = 0; n < coil_sizes; ++n) {
    const double per_size = corrected * force.row_slope * run.per_size[k][static_cast<std::size_t>(n)];
    out.row.emplace_back(layout.coil_at(n), per_size);
    out.right += per_size * at[static_cast<std::size_t>(n)];
  }
  return out;
}

/// Means of equations over so much travel one way. A slow spool that sticks and slips has the friction of sliding on
/// the average: what it holds more before a slip, it holds less after it.
class Means {
 public:
  Means(std::vector<Equation>& to, double travel_m, int unknowns)
      : to_(to), travel_m_(travel_m), sum_(Eigen::VectorXd::Zero(unknowns)) {}

  void add(const Equation& equation, const SlidingSample& sample) {
    if (sample.direction != direction_ || std::abs(sample.position_m - from_m_) >= travel_m_) {
      end();
      direction_ = sample.direction;
      from_m_ = sample.position_m;
    }
    for (const auto& [k, share] : equation.row) {
      if (sum_(k) == 0) used_.push_back(k);
      sum_(k) += share;
    }
    right_ += equation.right;
    ++samples_;
  }
  void end() {
    if (samples_ == 0) return;
    Equation mean{{}, right_ / samples_, samples_};
    for (const int k : used_) {
      if (sum_(k) != 0) mean.row.emplace_back(k, sum_(k) / samples_);
      sum_(k) = 0;
    }
    to_.push_back(std::move(mean));
    used_.clear();
    right_ = samples_ = 0;
  }

 private:
  std::vector<Equation>& to_;
  double travel_m_;
  Eigen::VectorXd sum_;
  std::vector<int> used_;  ///< entries of `sum_`; one whose sum was zero in between stands twice
  double right_ = 0, samples_ = 0, direction_ = 0, from_m_ = 0;
};

/// Second differences along a row of unknowns vanish within `bend`.
template <class At>
void add_smooth(Equations& to, int count, double bend, const At& at) {
  for (int k = 1; k + 1 < count; ++k) to.add({{at(k - 1), 1.0}, {at(k), -2.0}, {at(k + 1), 1.0}}, 0, bend);
}

/// Neighbours are alike within `step`.
template <class At>
void add_alike(Equations& to, int count, double step, const At& at) {
  for (int k = 0; k + 1 < count; ++k) to.add({{at(k), 1.0}, {at(k + 1), -1.0}}, 0, step);
}

void add_priors(Equations& to, const ForceLayout& l, const ForcePriors& priors) {
  for (int i = 0; i < l.currents.count; ++i) {
    for (int p = 0; p < l.places.count; ++p) to.add({{l.map_at(i, p), 1.0}}, 0, priors.map_share);
    add_smooth(to, l.places.count, priors.map_bend, [&](int k) { return l.map_at(i, k); });
  }
  for (int p = 0; p < l.places.count; ++p)
    add_smooth(to, l.currents.count, priors.map_bend, [&](int k) { return l.map_at(k, p); });
  for (int k = 0; k < l.spring.count; ++k) to.add({{l.spring_at(k), 1.0}}, 0, 1e3);
  add_smooth(to, l.spring.count, 0.05, [&](int k) { return l.spring_at(k); });
  for (int layer = 0; layer < l.layers(); ++layer) {
    for (int k = 0; k < l.force.count; ++k) to.add({{l.force_at(layer, k), 1.0}}, 0, 10);
    add_smooth(to, l.force.count, 0.01, [&](int k) { return l.force_at(layer, k); });
    to.add({{l.force_at(layer, 0), 1.0}}, 0, 1e-3);  // closed: no flow
    for (int k = 0; k < l.dry.count; ++k) to.add({{l.dry_at(layer, k), 1.0}}, 0, 30);
    add_alike(to, l.dry.count, 0.3, [&](int k) { return l.dry_at(layer, k); });
    for (int k = 0; k < l.loaded.count; ++k) to.add({{l.loaded_at(layer, k), 1.0}}, 0, 1);
    add_smooth(to, l.loaded.count, 0.01, [&](int k) { return l.loaded_at(layer, k); });
  }
  for (int layer = 0; layer + 1 < l.layers(); ++layer) {  // what no stroke reached at one temperature, others did
    if ((layer + 1) % l.layers_of_edge() == 0) continue;  // the next is of the other edge
    for (int k = 0; k < l.force.count; ++k)
      to.add({{l.force_at(layer, k), 1.0}, {l.force_at(layer + 1, k), -1.0}}, 0, 0.05);
    for (int k = 0; k < l.loaded.count; ++k)
      to.add({{l.loaded_at(layer, k), 1.0}, {l.loaded_at(layer + 1, k), -1.0}}, 0, 0.02);
    for (int k = 0; k < l.dry.count; ++k) to.add({{l.dry_at(layer, k), 1.0}, {l.dry_at(layer + 1, k), -1.0}}, 0, 0.5);
  }
  to.add({{l.mass(), 1.0}}, priors.mass_kg, 0.5 * priors.mass_kg);
  for (int k = 0; k < coil_sizes; ++k) {
    const auto n = static_cast<std::size_t>(k);
    to.add({{l.coil_at(k), 1.0}}, priors.coil[n], priors.coil_deviation[n]);
  }
}

void add_measured(Equations& to, const ForceLayout& l, const std::vector<MeasuredForce>& measured, double deviation_N) {
  for (const MeasuredForce& each : measured) {
    const Knots::Place s = l.spring.at(each.position_m);
    Row row{{l.spring_at(s.lower), 1 - s.share}, {l.spring_at(s.lower + 1), s.share}};
    add_layers(row, l, layer_at(l, each.oil_temperature_K, 0), l.force, each.position_m,
               1e-5 * each.pressure_difference_Pa, [&](int layer, int k) { return l.force_at(layer, k); });
    to.add(row, each.force_N, deviation_N);
  }
}

/// Over all samples together the magnetic force keeps the coenergy's size: with all forces in proportion the residuals
/// shrink, too, so that they cannot show it.
void add_scale(Equations& to, const ForceLayout& l, const std::vector<Equation>& all, double deviation) {
  std::vector<double> share(static_cast<std::size_t>(l.spring_at(0)), 0.0);
  double sum_N = 0;
  for (const Equation& each : all) {
    for (const auto& [k, of_k] : each.row) {
      if (k >= l.spring_at(0)) continue;
      share[static_cast<std::size_t>(k)] += each.samples * of_k;
      sum_N += each.samples * of_k;
    }
  }
  if (!(sum_N > 0)) return;
  Row row;
  for (int k = 0; k < l.spring_at(0); ++k) row.emplace_back(k, share[static_cast<std::size_t>(k)] / sum_N);
  to.add(row, 0, deviation);
}

double deviation_of(const Equation& equation, const Eigen::VectorXd& unknowns) {
  double out = -equation.right;
  for (const auto& [k, share] : equation.row) out += share * unknowns(k);
  return out;
}

}  // namespace

Knots::Place Knots::at(double x) const {
  const double raw = std::clamp(x / end * (count - 1), 0.0, static_cast<double>(count - 1));
  const int lower = std::min(static_cast<int>(raw), count - 2);
  return {lower, raw - lower};
}

ForceLayout::ForceLayout(double largest_current, double stroke, std::vector<double> temperatures, int edges_apart)
    : largest_current_A(largest_current),
      stroke_m(stroke),
      temperatures_K(std::move(temperatures)),
      edges(edges_apart) {
  currents.end = largest_current;
  for (Knots* knots : {&places, &spring, &force, &dry, &loaded}) knots->end = stroke;
}

ForceSolution solve_forces(const ForceLayout& layout, const ForcePriors& priors,
                           const sensor::MagneticForce<double>& coenergy_force, const std::vector<RunForces>& runs,
                           const CoilSizes& at, const Eigen::VectorXd& before) {
  std::vector<Equation> all;
  Means means(all, priors.mean_travel_m, layout.unknowns());
  std::size_t samples = 0;
  for (const RunForces& run : runs) {
    for (std::size_t k = 0; k < run.samples->size(); ++k, ++samples)
      means.add(equation_of(layout, coenergy_force, run, k, at, before), (*run.samples)[k]);
    means.end();
  }
  ForceSolution out{before, {}, usual_residual_N, 0, samples};
  constexpr int rounds = 2;  // of weights
  for (int round = before.size() == 0 ? 0 : 1; round < rounds; ++round) {
    Equations equations(layout.unknowns());
    add_priors(equations, layout, priors);
    const double deviation_N = out.residual_N * std::sqrt(samples_alike);
    add_measured(equations, layout, priors.measured, out.residual_N * std::sqrt(measured_alike));
    if (priors.measured.empty()) add_scale(equations, layout, all, priors.map_scale);
    for (const Equation& each : all) {
      const double away = out.unknowns.size() == 0 ? 0 : deviation_of(each, out.unknowns) / (3 * out.residual_N);
      equations.add(each.row, each.right, deviation_N * std::sqrt((1 + away * away) / each.samples));
    }
    out.covariance = equations.inverse();
    out.unknowns = out.covariance * equations.right();
    std::vector<double> sizes;
    for (const Equation& each : all) {
      sizes.push_back(std::abs(deviation_of(each, out.unknowns)));
      out.largest_N = std::max(out.largest_N, sizes.back());
    }
    constexpr double of_normal = 1.4826;
    if (!sizes.empty()) out.residual_N = std::max(0.02, of_normal * numerics::median(std::move(sizes)));
  }
  return out;
}

sensor::MagneticForce<double> corrected_map(const ForceLayout& layout,
                                            const sensor::MagneticForce<double>& coenergy_force,
                                            const Eigen::VectorXd& unknowns) {
  sensor::MagneticForce<double> out = coenergy_force;
  for (int row = 0; row < sensor::force_map_currents; ++row) {
    const Knots::Place i = layout.currents.at(out.map.row_axis.at(row));
    for (int column = 0; column < sensor::force_map_positions; ++column) {
      const Knots::Place p = layout.places.at(out.map.column_axis.at(column));
      const auto at = [&](int r, int c) { return unknowns(layout.map_at(i.lower + r, p.lower + c)); };
      const double share = (1 - i.share) * ((1 - p.share) * at(0, 0) + p.share * at(0, 1)) +
                           i.share * ((1 - p.share) * at(1, 0) + p.share * at(1, 1));
      out.map.node(row, column) *= 1 + share;
    }
  }
  return out;
}

}  // namespace spoolflow::calibration

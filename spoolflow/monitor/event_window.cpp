#include "spoolflow/monitor/event_window.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "spoolflow/monitor/dense.hpp"

namespace spoolflow::monitor {
namespace {

/// How the pressure difference may move within a window: a random walk [share of the highest per root of a second], and
/// a load behind the valve (share of the pressure difference that it takes when fully open), both one standard
/// deviation.
struct Restlessness {
  double walk_share;
  double load_share;
  double before;  ///< ln of how likely it is before anything is seen, to the first
};
constexpr std::array<Restlessness, 4> restless{{{0.004, 0.03, 0}, {0.004, 0.3, 0}, {0.04, 0.3, -3}, {0.17, 0.5, -5}}};
/// Beyond the first only friction is identified: what a load takes has the shape of faults.
constexpr std::size_t steady_kinds = 1;
/// What is known of the pressure difference at first, as a share of the highest.
constexpr double pressure_deviation_share = 0.35;
/// The pressure difference is sought with friction free and all else as near to the model as this share of a fault.
constexpr double others_while_seeking = 0.3;
constexpr int most_iterations = 5;
constexpr int least_iterations = 3;
constexpr double settled_share = 0.02;    ///< of the highest: the pressure difference is found
constexpr double unsettled_share = 0.06;  ///< beyond it is not
/// Events further off than so many standard deviations count less, by the square of how much further.
constexpr double unusual_deviations = 2;
constexpr double largest_misfit = 2.5;
/// A shape is identified where the model holds better than this, ...
constexpr double largest_shape_misfit = 0.6;
/// ... and where the pressure difference is no less than this share of the highest: oil that loads hold back has no
/// shape of its own.
constexpr double least_shape_pressure_share = 0.1;
/// A misfit below this is not accepted.
constexpr double least_misfit = 0.3;

/// Friction over its map differs from place to place: one standard deviation as a share of the limit, alike within this
/// share of the stroke, and the same both ways.
constexpr double friction_shape_share = 0.08;
constexpr double friction_shape_length = 0.25;

/// What rest adds to friction is no better known than by this share of it, one standard deviation, alike in a window.
constexpr double ageing_share = 0.15;

/// The window's equations about one pressure difference.
struct Equations {
  std::size_t size = 0;
  std::array<Explained, window_events> row;
  std::array<double, window_events> variance_N2;
  std::vector<double> friction_N2;  ///< covariance of the residuals by what friction may differ, row after row
};

/// Covariance of two residuals by what friction differs from its map, and rest from what it adds.
double friction_covariance_N2(double stroke_m, const ForceEvent& one, const Explained& a, const ForceEvent& other,
                              const Explained& b) {
  const double apart = std::abs(one.position_m - other.position_m) / (friction_shape_length * stroke_m);
  return one.direction * other.direction *
         (friction_shape_share * friction_shape_share * a.friction_limit_N * b.friction_limit_N * std::exp(-apart) +
          ageing_share * ageing_share * a.ageing_N * b.ageing_N);
}

/// Covariance of the residuals with magnitudes of standard deviations `magnitude_scale`, factorised; empty on failure.
std::vector<double> factor_of(const Equations& equations, const WindowState& window, const Restlessness& how,
                              double highest_Pa, const Magnitudes& magnitude_scale) {
  const std::size_t n = equations.size;
  std::vector<double> out(n * n);
  const double first2 = std::pow(pressure_deviation_share * highest_Pa, 2);
  const double walk2 = std::pow(how.walk_share * highest_Pa, 2);
  const double load2 = how.load_share * how.load_share;
  const double begin_s = window.events[0].time_s;
  for (std::size_t r = 0; r < n; ++r) {
    const Explained& a = equations.row[r];
    Magnitudes scaled_N = a.slope_N;
    for (std::size_t k = 0; k < magnitudes; ++k) scaled_N[k] *= magnitude_scale[k] * magnitude_scale[k];
    for (std::size_t c = 0; c <= r; ++c) {
      const Explained& b = equations.row[c];
      const double since_s = std::min(window.events[r].time_s, window.events[c].time_s) - begin_s;
      out[r * n + c] = a.per_pressure_N_Pa * b.per_pressure_N_Pa * (first2 + walk2 * since_s) +
                       load2 * a.load_slope_N * b.load_slope_N + equations.friction_N2[r * n + c] +
                       product(scaled_N, b.slope_N);
    }
    out[r * n + r] += equations.variance_N2[r];
  }
  if (!factorise(out, n)) out.clear();
  return out;
}

std::vector<double> residuals(const Equations& equations) {
  std::vector<double> out(equations.size);
  for (std::size_t k = 0; k < equations.size; ++k) out[k] = equations.row[k].residual_N;
  return out;
}

constexpr Magnitudes filled(double value) {
  Magnitudes out{};
  out.fill(value);
  return out;
}

/// J^T S^-1 J and J^T S^-1 y without the magnitudes in S.
Evidence evidence_of(const Equations& equations, const std::vector<double>& factor) {
  const std::size_t n = equations.size;
  Evidence out;
  std::vector<double> solved = residuals(equations);
  solve_in_place(factor, n, solved);
  for (std::size_t k = 0; k < magnitudes; ++k) {
    std::vector<double> column(n);
    for (std::size_t r = 0; r < n; ++r) {
      column[r] = equations.row[r].slope_N[k];
      out.pull[k] += column[r] * solved[r];
    }
    solve_in_place(factor, n, column);
    for (std::size_t j = 0; j < magnitudes; ++j) {
      for (std::size_t r = 0; r < n; ++r)
        out.information[j * magnitudes + k] += equations.row[r].slope_N[j] * column[r];
    }
  }
  return out;
}

/// Mean squared residual over its expectation, magnitudes of usual faults taken out.
double misfit_of(const Equations& equations, const std::vector<double>& factor, const Evidence& evidence) {
  const std::vector<double> y = residuals(equations);
  std::vector<double> solved = y;
  solve_in_place(factor, equations.size, solved);
  double sum = product(y, solved);
  MagnitudeMatrix a = evidence.information;
  for (std::size_t k = 0; k < magnitudes; ++k) a[k * magnitudes + k] += 1;
  Magnitudes x = evidence.pull;
  if (!factorise(a, magnitudes)) return largest_misfit + 1;
  solve_in_place(a, magnitudes, x);
  sum -= product(evidence.pull, x);
  return sum / static_cast<double>(equations.size);
}

/// A restlessness, and the covariance that it makes, factorised; empty where it has none.
struct Likeliest {
  std::size_t kind = 0;
  std::vector<double> factor;
};

/// The likeliest restlessness, faults of usual size allowed.
Likeliest likeliest(const Equations& equations, const WindowState& window, double highest_Pa) {
  Likeliest best;
  double most = -1e300;
  for (std::size_t k = 0; k < restless.size(); ++k) {
    std::vector<double> factor = factor_of(equations, window, restless[k], highest_Pa, filled(1));
    if (factor.empty()) continue;
    std::vector<double> solved = residuals(equations);
    const std::vector<double> y = solved;
    solve_in_place(factor, equations.size, solved);
    const double likelihood = restless[k].before - 0.5 * (log_determinant(factor, equations.size) + product(y, solved));
    if (likelihood > most) {
      most = likelihood;
      best = {k, std::move(factor)};
    }
  }
  return best;
}

/// By how much the pressure difference is off [Pa].
double pressure_error_Pa(const Equations& equations, const WindowState& window, const Restlessness& how,
                         double highest_Pa) {
  Magnitudes scale = filled(others_while_seeking);
  scale[index(Magnitude::friction)] = 1;
  const std::vector<double> factor = factor_of(equations, window, how, highest_Pa, scale);
  if (factor.empty()) return 0;
  std::vector<double> solved = residuals(equations);
  solve_in_place(factor, equations.size, solved);
  double sum = 0;
  for (std::size_t k = 0; k < equations.size; ++k) sum += equations.row[k].per_pressure_N_Pa * solved[k];
  return std::pow(pressure_deviation_share * highest_Pa, 2) * sum;
}

/// Events that nothing explains count less.
void weigh_unusual(const Equations& equations, const std::vector<double>& factor,
                   std::array<double, window_events>& weight) {
  if (factor.empty()) return;
  std::vector<double> solved = residuals(equations);
  solve_in_place(factor, equations.size, solved);
  for (std::size_t k = 0; k < equations.size; ++k) {
    const double own = std::abs(solved[k]) * std::sqrt(equations.variance_N2[k]);
    const double further = std::max(1.0, own / unusual_deviations);
    weight[k] *= further * further;
  }
}

void set_up(const sensor::ObserverParameters<double>& valve, double stroke_m, const WindowState& window,
            double pressure_Pa, const std::array<double, window_events>& weight, Equations& equations) {
  const std::size_t n = window.count;
  equations.size = n;
  equations.friction_N2.assign(n * n, 0);
  for (std::size_t r = 0; r < n; ++r) {
    const ForceEvent& event = window.events[r];
    equations.row[r] = explain(valve, stroke_m, event, pressure_Pa);
    equations.variance_N2[r] = std::pow(equations.row[r].noise_N, 2) * weight[r];
    for (std::size_t c = 0; c <= r; ++c) {
      equations.friction_N2[r * n + c] =
          friction_covariance_N2(stroke_m, event, equations.row[r], window.events[c], equations.row[c]);
    }
  }
}

double middle_pressure_Pa(const WindowState& window) {
  std::array<double, window_events> values{};
  for (std::size_t k = 0; k < window.count; ++k) values[k] = window.events[k].pressure_difference_Pa;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(window.count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(window.count));
  return *middle;
}

/// The share of events that go the rarer way.
double return_share(const WindowState& window) {
  double opening = 0;
  for (std::size_t k = 0; k < window.count; ++k) opening += window.events[k].direction > 0 ? 1 : 0;
  const double share = opening / static_cast<double>(window.count);
  return std::min(share, 1 - share);
}

/// Friction alone, the other magnitudes unknown to the size of usual faults.
Evidence friction_only(const Evidence& all) {
  constexpr std::size_t O = magnitudes - 1;
  std::array<double, O * O> others{};
  std::array<double, O> cross{}, pull{};
  for (std::size_t r = 0; r < O; ++r) {
    cross[r] = all.information[(r + 1) * magnitudes];
    pull[r] = all.pull[r + 1];
    for (std::size_t c = 0; c < O; ++c)
      others[r * O + c] = all.information[(r + 1) * magnitudes + c + 1] + (r == c ? 1 : 0);
  }
  Evidence out;
  if (!factorise(others, O)) return out;
  std::array<double, O> solved = cross;
  solve_in_place(others, O, solved);
  out.information[0] = all.information[0] - product(cross, solved);
  out.pull[0] = all.pull[0] - product(pull, solved);
  return out;
}

}  // namespace

std::optional<WindowResult> fit_window(const sensor::ObserverParameters<double>& valve, double stroke_m,
                                       const WindowState& window) {
  if (window.count < least_window_events) return {};
  if (return_share(window) < least_return_share) return {};
  const double highest_Pa = valve.edge.highest_pressure_difference_Pa();
  const double margin_Pa = 0.03 * highest_Pa;
  double pressure_Pa = middle_pressure_Pa(window);
  std::array<double, window_events> weight{};
  weight.fill(1);
  Equations equations;
  std::size_t kind = 0;
  double error_Pa = 0;
  for (int iteration = 0;; ++iteration) {
    set_up(valve, stroke_m, window, pressure_Pa, weight, equations);
    const Likeliest found = likeliest(equations, window, highest_Pa);
    kind = found.kind;
    if (iteration < 2) weigh_unusual(equations, found.factor, weight);
    error_Pa = pressure_error_Pa(equations, window, restless[kind], highest_Pa);
    const bool settled = std::abs(error_Pa) < settled_share * highest_Pa;
    if (iteration + 1 >= least_iterations && (settled || iteration + 1 >= most_iterations)) break;
    pressure_Pa = std::clamp(pressure_Pa + error_Pa, margin_Pa, extrapolated_share * highest_Pa);
  }
  const std::vector<double> factor = factor_of(equations, window, restless[kind], highest_Pa, filled(0));
  if (factor.empty()) return {};
  WindowResult out{evidence_of(equations, factor), pressure_Pa, 0, kind < steady_kinds, window.count, {}, {}};
  out.misfit = misfit_of(equations, factor, out.evidence);
  const bool settled = std::abs(error_Pa) < unsettled_share * highest_Pa;
  if (!settled || out.misfit > largest_shape_misfit || pressure_Pa < least_shape_pressure_share * highest_Pa)
    out.shape_shows = false;
  if (out.misfit > largest_misfit) return {};
  if (settled && kind < steady_kinds) out.contact = read_contacts(valve, stroke_m, window, pressure_Pa);
  if (!out.shape_shows) out.evidence = friction_only(out.evidence);
  const SpeedEffect by_speed = friction_by_speed(window, stroke_m);
  out.friction_unknown = by_speed.unknown;
  for (std::size_t k = 0; k < magnitudes; ++k)
    out.evidence.pull[k] += by_speed.less * out.evidence.information[k * magnitudes + index(Magnitude::friction)];
  const double scale = 1 / std::max(out.misfit, least_misfit);
  for (double& value : out.evidence.information) value *= scale;
  for (double& value : out.evidence.pull) value *= scale;
  return out;
}

std::optional<WindowResult> end_window(const sensor::ObserverParameters<double>& valve, double stroke_m,
                                       WindowState& window) {
  const std::optional<WindowResult> out = fit_window(valve, stroke_m, window);
  window.count = 0;
  return out;
}

namespace {

/// Break-aways and sliding are alike but for their rests; under dither friction is another.
bool alike(const ForceEvent& a, const ForceEvent& b, double stroke_m) {
  return a.direction == b.direction && (a.kind == EventKind::dithered) == (b.kind == EventKind::dithered) &&
         std::abs(a.position_m - b.position_m) < alike_position_share * stroke_m && b.time_s - a.time_s < alike_time_s;
}

void merge(ForceEvent& into, const ForceEvent& event) {
  into.count += 1;
  const double share = 1 / into.count;
  const auto mean = [&](double& value, double other) { value += share * (other - value); };
  mean(into.time_s, event.time_s);
  mean(into.position_m, event.position_m);
  mean(into.net_force_N, event.net_force_N);
  mean(into.rested_s, event.rested_s);
  mean(into.friction_N, event.friction_N);
  mean(into.current_A, event.current_A);
  mean(into.oil_temperature_K, event.oil_temperature_K);
  mean(into.pressure_difference_Pa, event.pressure_difference_Pa);
}

}  // namespace

std::optional<WindowResult> add_event(const sensor::ObserverParameters<double>& valve, double stroke_m,
                                      WindowState& window, const ForceEvent& event) {
  std::optional<WindowResult> out;
  // A hunting spool breaks away to and fro: the one before the last may be alike, too.
  for (std::size_t back = 1; back <= 2 && back <= window.count; ++back) {
    ForceEvent& before = window.events[window.count - back];
    if (!alike(before, event, stroke_m)) continue;
    merge(before, event);
    return out;
  }
  if (window.count > 0) {
    const bool pauses = event.time_s - window.events[window.count - 1].time_s > longest_event_gap_s;
    if (pauses || window.count == window_events || event.time_s - window.events[0].time_s > longest_window_s)
      out = end_window(valve, stroke_m, window);
  }
  window.events[window.count++] = event;
  return out;
}

}  // namespace spoolflow::monitor

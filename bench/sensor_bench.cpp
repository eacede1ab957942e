/// What one step of a sensor costs on a host, on the samples of a recorded run, beside what one would write by hand.
/// Run: sensor_bench. The recordings of examples/ are simulated.
#include <algorithm>
#include <array>
#include <vector>

#include <Eigen/Core>
#include <benchmark/benchmark.h>

#include "spoolflow/calibration/calibrate.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "spoolflow/recording/campaign.hpp"
#include "spoolflow/recording/reader.hpp"
#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer.hpp"

namespace spoolflow::bench {
namespace {

const model::Model& valve() {
  static const model::Model model =
      calibration::calibrate(recording::read_campaign(SPOOLFLOW_EXAMPLES "/valve_a/campaign.toml"), "bench",
                             [](const std::string&, double) {});
  return model;
}

/// One run, again and again.
const std::vector<sensor::Sample<double>>& samples() {
  static const std::vector<sensor::Sample<double>> run = [] {
    using recording::Channel;
    const recording::Recording file = recording::read_recording(SPOOLFLOW_EXAMPLES "/valve_a/ramp_60bar.h5",
                                                                estimation::sensor_channels(valve(), {}));
    std::vector<sensor::Sample<double>> out;
    for (std::size_t k = 0; k < file.size(); ++k) {
      out.push_back({k == 0 ? 0 : file[Channel::time][k] - file[Channel::time][k - 1], file[Channel::current][k],
                     file[Channel::voltage][k], file[Channel::position][k], file[Channel::oil_temperature][k]});
    }
    return out;
  }();
  return run;
}

template <class Step>
void over_the_run(benchmark::State& state, Step step) {
  const auto& run = samples();
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(step(run[k]));
    if (++k == run.size()) k = 0;
  }
}

void condensed_step(benchmark::State& state) {
  const auto tables = sensor::laid_out(valve().condensed.parameters);
  sensor::CondensedState<double> memory;
  over_the_run(state, [&](const auto& sample) { return sensor::step(tables, memory, sample); });
}
BENCHMARK(condensed_step);

/// The same two maps and a spring as one would write them at first: sorted axes, std::lower_bound, bilinear; no band,
/// no status.
struct PlainMap {
  std::vector<double> rows, columns, values;

  [[nodiscard]] double at(double row, double column) const {
    const auto cell = [](const std::vector<double>& axis, double value) {
      const auto above = std::lower_bound(axis.begin() + 1, axis.end() - 1, value);
      return static_cast<std::size_t>(above - axis.begin()) - 1;
    };
    const std::size_t r = cell(rows, row);
    const std::size_t c = cell(columns, column);
    const double u = std::clamp((row - rows[r]) / (rows[r + 1] - rows[r]), 0.0, 1.0);
    const double v = std::clamp((column - columns[c]) / (columns[c + 1] - columns[c]), 0.0, 1.0);
    const double* low = &values[r * columns.size() + c];
    const double* high = low + columns.size();
    return (1 - u) * ((1 - v) * low[0] + v * low[1]) + u * ((1 - v) * high[0] + v * high[1]);
  }
};

template <int Points>
std::vector<double> grid(const sensor::Axis<double>& axis) {
  std::vector<double> out;
  for (int k = 0; k < Points; ++k) out.push_back(axis.at(k));
  return out;
}

template <int Rows, int Columns>
PlainMap plain(const sensor::Map<double, Rows, Columns>& map) {
  return {grid<Rows>(map.row_axis), grid<Columns>(map.column_axis), {map.values.begin(), map.values.end()}};
}

void plain_lower_bound_maps(benchmark::State& state) {
  const auto& parameters = valve().condensed.parameters;
  const PlainMap force = plain(parameters.magnetic_force.map);
  const PlainMap flow = plain(parameters.flow_rate.flow_m3_per_s);
  over_the_run(state, [&](const auto& sample) {
    const double flow_force_N =
        force.at(sample.current_A, sample.position_m) - parameters.spring.at(sample.position_m).value;
    const double share = flow_force_N / parameters.flow_rate.largest_force_N.at(sample.position_m).value;
    return flow.at(sample.position_m, std::sqrt(std::clamp(share, 0.0, 1.0)));
  });
}
BENCHMARK(plain_lower_bound_maps);

/// In one piece, as docs/embedded.md asks of who calls it.
[[gnu::flatten]] const sensor::Estimate<double>& whole_step(const sensor::ObserverParameters<double>& parameters,
                                                            sensor::ObserverState<double>& memory,
                                                            const sensor::Sample<double>& sample) {
  return sensor::step(parameters, memory, sample);
}

void observer_step(benchmark::State& state) {
  if (!valve().observer) {
    state.SkipWithError("the model has no observer");
    return;
  }
  const auto& parameters = valve().observer->parameters;
  sensor::ObserverState<double> memory;
  over_the_run(
      state, [&](const auto& sample) -> const auto& { return whole_step(parameters, memory, sample); });
}
BENCHMARK(observer_step);

/// A textbook extended Kalman filter with four states (position, velocity, friction, pressure difference) and two
/// measurements (position, force), models already linear: the least that a general filter costs.
void plain_eigen_filter(benchmark::State& state) {
  using Matrix4 = Eigen::Matrix4d;
  using Matrix24 = Eigen::Matrix<double, 2, 4>;
  Eigen::Vector4d x = Eigen::Vector4d::Zero();
  Matrix4 covariance = Matrix4::Identity();
  const Matrix4 process = 1e-3 * Matrix4::Identity();
  const Eigen::Matrix2d noise = 1e-2 * Eigen::Matrix2d::Identity();
  Matrix24 output = Matrix24::Zero();
  output(0, 0) = output(1, 2) = output(1, 3) = 1;
  over_the_run(state, [&](const auto& sample) {
    Matrix4 transition = Matrix4::Identity();
    transition(0, 1) = sample.time_step_s;
    x = transition * x;
    covariance = transition * covariance * transition.transpose() + process;
    const Eigen::Vector2d surprise = Eigen::Vector2d(1e3 * sample.position_m, sample.current_A) - output * x;
    const Eigen::Matrix2d spread = output * covariance * output.transpose() + noise;
    const double determinant = spread(0, 0) * spread(1, 1) - spread(0, 1) * spread(1, 0);
    Eigen::Matrix2d inverse;
    inverse << spread(1, 1), -spread(0, 1), -spread(1, 0), spread(0, 0);
    inverse /= determinant;
    const Eigen::Matrix<double, 4, 2> gain = covariance * output.transpose() * inverse;
    x += gain * surprise;
    covariance = (Matrix4::Identity() - gain * output) * covariance;
    return x(3);
  });
}
BENCHMARK(plain_eigen_filter);

}  // namespace
}  // namespace spoolflow::bench

BENCHMARK_MAIN();

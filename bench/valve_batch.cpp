/// The condensed sensor over many valves: one after the other, and 8 or 16 at once in SIMD registers, in one run.
/// valve_batch MODEL.json
#include "spoolflow/validation/valve_batch.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/export/number_groups.hpp"
#include "spoolflow/model/model.hpp"

namespace {

using namespace spoolflow;
constexpr int samples = 4096;
constexpr int rounds = 60;

/// Nanoseconds of the fastest of some rounds.
template <class Work>
double fastest_ns(const Work& work) {
  double fastest = 1e12;
  for (int round = 0; round < rounds; ++round) {
    const auto begun = std::chrono::steady_clock::now();
    work();
    fastest =
        std::min(fastest, std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begun).count());
  }
  return fastest;
}

/// A sample's four measured numbers, valve beside valve, and the two answers.
template <int N>
struct Signals {
  using Row = std::array<float, N>;
  std::vector<Row> current_A, voltage_V, position_m, temperature_K, flow, pressure;

  explicit Signals(const model::Model& model) {
    const auto& parameters = model.condensed.parameters;
    for (int k = 0; k < samples; ++k) {
      Row current{}, position{}, other{};
      for (std::size_t valve = 0; valve < N; ++valve) {
        const auto phase = static_cast<float>((k * 7 + static_cast<int>(valve) * 613) % samples) / samples;
        position[valve] = phase * static_cast<float>(model.valve.stroke_m);
        current[valve] = (0.3F + 0.5F * phase) *
                         static_cast<float>(parameters.magnetic_force.map.row_axis.at(sensor::force_map_currents - 1));
        other[valve] = 320;
      }
      current_A.push_back(current);
      position_m.push_back(position);
      voltage_V.push_back(other);
      temperature_K.push_back(other);
    }
    flow.resize(samples);
    pressure.resize(samples);
  }
};

double per_valve(double ns, int valves) {
  return ns / samples / valves;
}

template <int N>
void compare(const model::Model& model) {
  const auto single = exports::single_precision(sensor::laid_out(model.condensed.parameters));
  std::array<sensor::CondensedTables<float>, N> valves;
  valves.fill(single);
  std::array<sensor::CondensedState<float>, N> states{};
  Signals<N> signals(model);
  const double alone_ns = fastest_ns([&] {
    for (std::size_t valve = 0; valve < N; ++valve) {
      for (std::size_t k = 0; k < samples; ++k) {
        const auto estimate =
            step(valves[valve], states[valve],
                 sensor::Sample<float>{1e-3F, signals.current_A[k][valve], signals.voltage_V[k][valve],
                                       signals.position_m[k][valve], signals.temperature_K[k][valve]});
        signals.flow[k][valve] = estimate.flow_m3_per_s;
        signals.pressure[k][valve] = estimate.pressure_difference_Pa;
      }
    }
  });
  std::array<const sensor::CondensedTables<float>*, N> in_batch;
  for (std::size_t valve = 0; valve < N; ++valve) in_batch[valve] = &valves[valve];
  validation::ValveBatch<N> batch(in_batch);
  using Pack = validation::ValvePack<N>;
  const double together_ns = fastest_ns([&] {
    for (std::size_t k = 0; k < samples; ++k) {
      const auto& estimate =
          batch.step(sensor::Sample<Pack>{Pack(1e-3F), Pack(signals.current_A[k]), Pack(signals.voltage_V[k]),
                                          Pack(signals.position_m[k]), Pack(signals.temperature_K[k])});
      signals.flow[k] = estimate.flow_m3_per_s.numbers();
      signals.pressure[k] = estimate.pressure_difference_Pa.numbers();
    }
  });
  const double touch_ns = fastest_ns([&] {
    for (std::size_t k = 0; k < samples; ++k) {
      for (std::size_t valve = 0; valve < N; ++valve) {
        signals.flow[k][valve] = signals.current_A[k][valve] + signals.voltage_V[k][valve];
        signals.pressure[k][valve] = signals.position_m[k][valve] + signals.temperature_K[k][valve];
      }
    }
  });
  fmt::print(
      "{:>2} valves, ns a sample and valve: one after the other {:.1f}, at once {:.1f} ({:.0f} %; wanted: at most "
      "40 %), reading four floats and writing two {:.2f}\n",
      N, per_valve(alone_ns, N), per_valve(together_ns, N), 100 * together_ns / alone_ns, per_valve(touch_ns, N));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: valve_batch MODEL.json\n");
    return 2;
  }
  try {
    const model::Model model = model::read_model(argv[1]);
    compare<8>(model);
    compare<16>(model);
  } catch (const std::exception& error) {
    fmt::print(stderr, "valve_batch: {}\n", error.what());
    return 1;
  }
  return 0;
}

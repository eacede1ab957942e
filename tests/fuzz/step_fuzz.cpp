/// The sensor's step over any samples: double and single precision, observer, condensed sensor and whole valve. Each
/// byte group is a sample: which of its numbers are extreme, and how. Whatever comes, an answer is finite, its band
/// holds it, and where an input was no number a fault reports it.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>

#include "spoolflow/model/model.hpp"
#include "spoolflow/sensor/observer.hpp"
#include "spoolflow/sensor/whole_valve/whole_condensed.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"
#include "tests/fuzz/input_file.hpp"

namespace {

using namespace spoolflow;

template <class T>
struct Valve {
  sensor::CondensedTables<T> condensed;
  sensor::ObserverParameters<T> observer;
};

struct Valves {
  Valve<double> exact;
  Valve<float> single;
};

/// Parameters are numbers and nothing else.
template <template <class> class Parameters>
Parameters<float> in_single(const Parameters<double>& parameters) {
  constexpr std::size_t count = sizeof(Parameters<double>) / sizeof(double);
  static_assert(sizeof(Parameters<float>) == count * sizeof(float));
  std::array<double, count> numbers;
  std::memcpy(numbers.data(), &parameters, sizeof numbers);
  std::array<float, count> single;
  for (std::size_t k = 0; k < count; ++k) single[k] = static_cast<float>(numbers[k]);
  return std::bit_cast<Parameters<float>>(single);
}

const Valves& valves() {
  static const std::unique_ptr<const Valves> read = [] {
    const model::Model model = model::read_model(SPOOLFLOW_FUZZ_MODEL);
    auto out = std::make_unique<Valves>();
    sensor::lay_out(model.condensed.parameters, out->exact.condensed);
    out->exact.observer = model.observer.value().parameters;
    out->single = {in_single(out->exact.condensed), in_single(out->exact.observer)};
    return out;
  }();
  return *read;
}

constexpr std::size_t sample_bytes = 10;

/// A number near `usual`, or any float at all.
template <class T>
T number(const std::uint8_t* at, T usual, T spread) {
  switch (at[0] % 16) {
    case 0:
      return std::numeric_limits<T>::quiet_NaN();
    case 1:
      return at[1] % 2 == 0 ? std::numeric_limits<T>::infinity() : -std::numeric_limits<T>::infinity();
    case 2: {
      const std::uint32_t bits =
          static_cast<std::uint32_t>(at[1]) << 24U | static_cast<std::uint32_t>(at[0]) << 16U | at[1];
      return T(std::bit_cast<float>(bits));
    }
    case 3:
      return T(0);
    case 4:
      return -usual;
    case 5:
      return usual * T(1e6);
    default:
      return usual + spread * (T(at[1]) - T(128)) / T(128);
  }
}

template <class T>
sensor::WholeValveSample<T> sample_of(const std::uint8_t* at) {
  sensor::WholeValveSample<T> out{number(at, T(1e-3), T(1e-3)), number(at + 1, T(0.2), T(2)),
                                  number(at + 2, T(1), T(2)),   number(at + 3, T(8), T(20)),
                                  number(at + 4, T(8), T(20)),  number(at + 5, T(0.5e-3), T(2e-3)),
                                  number(at + 6, T(313), T(60))};
  if (at[7] % 4 == 0) {
    out.ports = {number(at + 7, T(60e5), T(40e5)), number(at + 8, T(30e5), T(40e5)), number(at + 4, T(30e5), T(40e5)),
                 number(at + 2, T(1e5), T(40e5))};
  }
  return out;
}

template <class T>
void hold(const sensor::Estimate<T>& answer) {
  fuzz::require(std::isfinite(answer.flow_m3_per_s) && std::isfinite(answer.flow_lower_m3_per_s) &&
                std::isfinite(answer.flow_upper_m3_per_s));
  fuzz::require(answer.flow_lower_m3_per_s <= answer.flow_m3_per_s &&
                answer.flow_m3_per_s <= answer.flow_upper_m3_per_s);
}

template <class T>
void must_report(const sensor::Estimate<T>& answer, bool missing, bool endless) {
  if (missing) fuzz::require(has(answer.status, sensor::Status::sample_missing));
  if (endless) fuzz::require(has(answer.status, sensor::Status::time_fault));
}

template <class T>
void run(const Valve<T>& valve, const std::uint8_t* data, std::size_t size) {
  const sensor::WholeValveParameters<T> whole{&valve.observer, &valve.observer};
  const sensor::WholeCondensedTables<T> whole_tables{&valve.condensed, &valve.condensed};
  sensor::ObserverState<T> observer{};
  sensor::CondensedState<T> condensed{};
  sensor::WholeValveState<T> both{};
  sensor::WholeCondensedState<T> both_condensed{};
  for (; size >= sample_bytes; data += sample_bytes, size -= sample_bytes) {
    const sensor::WholeValveSample<T> in = sample_of<T>(data);
    const sensor::Sample<T> one = sensor::sample_of(in, false);
    const bool missing = std::isnan(one.current_A) || std::isnan(one.position_m);
    const bool endless = std::isnan(one.time_step_s) || one.time_step_s < 0 || one.time_step_s > 1;
    hold(step(valve.observer, observer, one));
    must_report(observer.last, missing, endless);
    hold(step(valve.condensed, condensed, one));
    must_report(condensed.last, missing && !endless, false);
    hold(step(whole, both, in));
    must_report(both.open.last, missing || std::isnan(in.current_a_A), endless);
    hold(step(whole_tables, both_condensed, in));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  run(valves().exact, data, size);
  run(valves().single, data, size);
  return 0;
}

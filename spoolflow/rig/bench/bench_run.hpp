#pragma once
/// What is planned for one recording: arrangement, the course of every set value, what is stored and how often.
#include <optional>
#include <vector>

#include "spoolflow/recording/channels/channel.hpp"
#include "spoolflow/rig/bench/course.hpp"
#include "spoolflow/rig/bench/machine.hpp"
#include "spoolflow/rig/electronics/electronics.hpp"
#include "spoolflow/rig/plant/valve_plant.hpp"

namespace spoolflow::rig {

/// What feeds the coil.
enum class CoilFeed {
  none,
  bench_amplifier,   ///< four-quadrant amplifier on solenoid b, by current or by voltage
  valve_electronics  ///< the valve's own position control
};

/// From the end of the span before until `until_s`.
template <class Value>
struct Span {
  double until_s;
  Value value;
};

/// The span that holds; asked at times that do not run backwards.
template <class Value>
class SpanReader {
 public:
  explicit SpanReader(const std::vector<Span<Value>>& spans) : spans_(spans) {}
  Value at(double time_s, Value otherwise) {
    const double roundoff_s = 1e-9;
    while (index_ < spans_.size() && time_s >= spans_[index_].until_s - roundoff_s) {
      ++index_;
    }
    return index_ < spans_.size() ? spans_[index_].value : otherwise;
  }

 private:
  const std::vector<Span<Value>>& spans_;
  std::size_t index_ = 0;
};

/// What a bench with a flow meter stores of a valve that strokes by its own electronics, in the order of the columns.
[[nodiscard]] inline std::vector<recording::Channel> metered_channels() {
  using recording::Channel;
  return {Channel::time,
          Channel::position_set,
          Channel::position,
          Channel::current,
          Channel::voltage,
          Channel::oil_temperature,
          Channel::pressure_difference,
          Channel::flow_reference};
}

/// How long a run lasts, how often it is sampled, from which oil temperature to which.
struct RunSpan {
  double duration_s, sample_rate_Hz, oil_temperature_start_C, oil_temperature_end_C;
};

struct BenchRun {
  Arrangement arrangement = Arrangement::valve;
  CoilFeed coil_feed = CoilFeed::valve_electronics;
  std::optional<LoadKind> load;  ///< what the bench hangs on the ports; absent: the valve's own load
  bool whole_valve = false;      ///< flow is signed, > 0 for P to B, and the pressure difference that of the open path
  Course position_set;           ///< share of the stroke, > 0 opens P to B; valve electronics
  Course motion_m;               ///< carriage or external drive; solenoid and axial-force bench
  Course current_A;              ///< bench amplifier
  Course voltage_V;              ///< bench amplifier, in the spans below where it holds the voltage
  std::vector<Span<bool>> voltage_held;
  Dither dither;              ///< on the bench amplifier's current; the valve's electronics have their own
  bool valve_dithers = true;  ///< false: the electronics' own is switched off
  Course pressure_difference_Pa;
  Course supply_pressure_Pa{100e5};        ///< loads orifice, cylinder and motor
  bool supply_follows_difference = false;  ///< then it is the course of the difference above the tank's pressure
  Course load_force_N;                     ///< on the cylinder, > 0 against moving out under flow from B
  Course oil_temperature_C{50};
  std::vector<Span<double>> sample_rate_Hz;
  std::vector<Span<double>> test;            ///< numbers of the parts; empty: none
  std::vector<recording::Channel> channels;  ///< in the order of the file's columns
  Machine machine;                           ///< round the valve at work
  double position_faults_per_s = 0;          ///< acquisition faults beside those of the LVDT's own figures

  void last_for(const RunSpan& span) {
    oil_temperature_C = Course(span.oil_temperature_start_C);
    oil_temperature_C.ramp_for(span.oil_temperature_end_C, span.duration_s);
    sample_rate_Hz = {{span.duration_s, span.sample_rate_Hz}};
  }
  [[nodiscard]] double duration_s() const { return sample_rate_Hz.empty() ? 0 : sample_rate_Hz.back().until_s; }
};

}  // namespace spoolflow::rig

#include "spoolflow/calibration/campaign_needs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "spoolflow/calibration/fits/bench_strokes.hpp"
#include "spoolflow/calibration/flow_bench/tracked_run.hpp"
#include "spoolflow/calibration/numerics/calibration_error.hpp"
#include "spoolflow/numerics/largest_magnitude.hpp"
#include "spoolflow/numerics/median.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;
using recording::Protocol;
using recording::Recording;

constexpr double pump_off_Pa = 2e5;
constexpr int least_levels = 3;
constexpr double same_temperature_K = 5;

/// Minutes of one recording as the docs describe it.
double minutes_of(Protocol protocol) {
  switch (protocol) {
    case Protocol::spring:
      return 1;
    case Protocol::solenoid_force_map:
    case Protocol::solenoid_dynamic:
      return 2.5;
    case Protocol::axial_force_map:
      return 6;
    case Protocol::metering:
      return 4;
    case Protocol::unpressurised_strokes:
    case Protocol::operation:
      return 1.5;
  }
  return 0;
}

/// By how much a channel moves to and fro altogether, in its largest values.
double travel(const std::vector<double>& values) {
  constexpr std::size_t every = 50;  // noise is no travel
  double out = 0;
  for (std::size_t k = every; k < values.size(); k += every) {
    const double step = std::abs(values[k] - values[k - every]);
    if (std::isfinite(step)) out += step;
  }
  return out / std::max(1e-300, numerics::largest_magnitude(values));
}

/// The mean pressure difference of each whole slow stroke up and down.
std::vector<double> slow_strokes_Pa(const Recording& recording) {
  constexpr double closed_share = 0.1, open_share = 0.85, slow_s = 8;
  const auto time_s = recording[Channel::time];
  const auto position_m = recording[Channel::position];
  const std::vector<double> pressure_Pa = pressure_difference_Pa(recording);
  const double most_m = numerics::largest_magnitude(recording.column(Channel::position));
  std::vector<double> out;
  double sum = 0, since_s = 0;
  std::size_t samples = 0;
  bool opened = false;
  for (std::size_t k = 0; k < recording.size(); ++k) {
    const double share = position_m[k] / most_m;
    if (share < closed_share) {
      if (opened && time_s[k] - since_s > slow_s)
        out.push_back(sum / static_cast<double>(std::max<std::size_t>(1, samples)));
      since_s = time_s[k];
      sum = 0;
      samples = 0;
      opened = false;
      continue;
    }
    opened = opened || share > open_share;
    if (pressure_Pa.empty() || !std::isfinite(pressure_Pa[k])) continue;
    sum += pressure_Pa[k];
    ++samples;
  }
  return out;
}

int levels_of(std::vector<double> strokes_Pa) {
  constexpr double apart = 1.12;
  std::sort(strokes_Pa.begin(), strokes_Pa.end());
  int out = 0;
  double last_Pa = 0;
  for (const double each : strokes_Pa) {
    if (each < pump_off_Pa || each < apart * last_Pa) continue;
    last_Pa = each;
    ++out;
  }
  return out;
}

/// Zero where nothing strokes by a current.
int stroke_levels(const Recording& recording) {
  const bool strokes = recording.has(Channel::position) && recording.has(Channel::current);
  return strokes ? levels_of(slow_strokes_Pa(recording)) : 0;
}

Recorded recorded_with(const Recording& recording, Protocol protocol, int levels) {
  return {protocol, "b", mean_oil_temperature_K(recording), levels, recording.has(Channel::voltage)};
}

Protocol by_own_solenoid(const Recording& recording, int levels) {
  const std::vector<double> pressure_Pa = pressure_difference_Pa(recording);
  if (pressure_Pa.empty() && !recording.has(Channel::flow_reference)) return Protocol::unpressurised_strokes;
  if (!pressure_Pa.empty() && numerics::largest_magnitude(pressure_Pa) < pump_off_Pa)
    return Protocol::unpressurised_strokes;
  return levels >= least_levels ? Protocol::metering : Protocol::operation;
}

/// What the recordings of one direction have.
class OfDirection {
 public:
  OfDirection(const std::vector<Recorded>& all, std::string direction) : direction_(std::move(direction)) {
    for (const Recorded& each : all) {
      if (each.direction == direction_) of_.push_back(&each);
    }
  }
  [[nodiscard]] bool has(Protocol protocol) const {
    return std::ranges::any_of(of_, [&](const Recorded* each) { return each->protocol == protocol; });
  }
  [[nodiscard]] NeededRecording needed(Protocol protocol, std::string why) const {
    return {protocol, direction_, std::move(why), minutes_of(protocol)};
  }
  /// Metering that shows the magnetic force as well.
  [[nodiscard]] bool meters_with_voltage() const {
    return std::ranges::any_of(of_, [](const Recorded* each) {
      return each->protocol == Protocol::metering && each->voltage && each->levels >= least_levels;
    });
  }
  [[nodiscard]] std::size_t temperatures(Protocol protocol) const {
    std::vector<double> known;
    for (const Recorded* each : of_) {
      if (each->protocol != protocol || std::isnan(each->oil_temperature_K)) continue;
      if (std::ranges::none_of(
              known, [&](double one) { return std::abs(one - each->oil_temperature_K) < same_temperature_K; }))
        known.push_back(each->oil_temperature_K);
    }
    return known.size();
  }
  /// Any recording with a force sensor.
  [[nodiscard]] bool measures_force() const {
    return has(Protocol::spring) || has(Protocol::solenoid_force_map) || has(Protocol::solenoid_dynamic) ||
           has(Protocol::axial_force_map);
  }
  void add_temperatures(std::vector<NeededRecording>& to, Protocol protocol) const {
    constexpr std::size_t enough = 3;
    const std::size_t known = std::max<std::size_t>(1, temperatures(protocol));
    if (known >= enough) return;
    to.push_back(needed(protocol, known + 1 == enough
                                      ? "at another oil temperature, 15 K or more from the others: viscosity"
                                      : "at two other oil temperatures, 15 K or more apart: viscosity"));
    to.back().minutes *= static_cast<double>(enough - known);
  }

 private:
  std::string direction_;
  std::vector<const Recorded*> of_;
};

/// Beside some force recording a flow bench shows what others are missing for.
void add_force_benches(ModelNeeds& to, const OfDirection& of) {
  const bool mixed = of.measures_force();
  const bool on_flow_bench = mixed && of.meters_with_voltage();
  if (!of.has(Protocol::spring) && !(mixed && of.has(Protocol::unpressurised_strokes)))
    to.missing.push_back(of.needed(Protocol::spring, "the springs"));
  if (!of.has(Protocol::solenoid_force_map) && !on_flow_bench)
    to.missing.push_back(of.needed(Protocol::solenoid_force_map, "the magnetic force"));
  if (!of.has(Protocol::axial_force_map) && !(mixed && of.has(Protocol::metering)))
    to.missing.push_back(of.needed(Protocol::axial_force_map, "flow force and conductance"));
  if (!of.has(Protocol::solenoid_dynamic) && !on_flow_bench)
    to.better.push_back(of.needed(Protocol::solenoid_dynamic, "hysteresis and eddy currents: the full sensor"));
  if (of.has(Protocol::axial_force_map)) of.add_temperatures(to.better, Protocol::axial_force_map);
}

void add_flow_bench(ModelNeeds& to, const OfDirection& of) {
  if (!of.has(Protocol::unpressurised_strokes) && !of.has(Protocol::spring))
    to.missing.push_back(of.needed(Protocol::unpressurised_strokes, "springs and friction, pump off"));
  const bool force_is_known = of.has(Protocol::solenoid_force_map);
  if (!of.has(Protocol::metering)) {
    to.missing.push_back(of.needed(Protocol::metering, "flow force, conductance and the magnetic force"));
  } else if (!force_is_known && !of.meters_with_voltage()) {
    to.missing.push_back(of.needed(
        Protocol::metering,
        fmt::format(
            "with the coil's voltage, one slow stroke both ways at each of {} pressure differences or more; the "
            "recordings that are there lack one of both",
            least_levels)));
  } else {
    of.add_temperatures(to.better, Protocol::metering);
  }
}

}  // namespace

Recorded recorded_by(const Recording& recording, Protocol protocol) {
  return recorded_with(recording, protocol, stroke_levels(recording));
}

Recorded recognised(const Recording& recording) {
  if (!recording.has(Channel::position)) {
    throw CalibrationError(
        fmt::format("{}: has no position, without which it serves no test", recording.file.filename().string()));
  }
  if (recording.has(Channel::axial_force)) {
    const bool pressure = numerics::largest_magnitude(pressure_difference_Pa(recording)) > pump_off_Pa;
    return recorded_by(recording, pressure ? Protocol::axial_force_map : Protocol::spring);
  }
  if (recording.has(Channel::force)) {
    const bool sweeps_position = !recording.has(Channel::test) &&
                                 (!recording.has(Channel::current) || travel(recording.column(Channel::position)) >
                                                                          travel(recording.column(Channel::current)));
    return recorded_by(recording, sweeps_position ? Protocol::solenoid_force_map : Protocol::solenoid_dynamic);
  }
  if (recording.has(Channel::current_a) && recording.has(Channel::current_b))
    return recorded_by(recording, Protocol::operation);
  if (!recording.has(Channel::current)) {
    throw CalibrationError(fmt::format("{}: has neither current nor a force, without which it serves no test",
                                       recording.file.filename().string()));
  }
  const int levels = stroke_levels(recording);
  return recorded_with(recording, by_own_solenoid(recording, levels), levels);
}

double ModelNeeds::missing_minutes() const {
  return std::accumulate(missing.begin(), missing.end(), 0.0,
                         [](double sum, const NeededRecording& each) { return sum + each.minutes; });
}

std::vector<ModelNeeds> needs_of(const std::vector<Recorded>& recorded) {
  std::vector<std::string> directions;
  for (const char* direction : {"b", "a"}) {
    if (std::ranges::any_of(recorded, [&](const Recorded& each) {
          return each.direction == direction && each.protocol != Protocol::operation;
        }))
      directions.emplace_back(direction);
  }
  if (directions.empty()) directions.emplace_back("b");
  ModelNeeds force{"force benches", {}, {}}, flow{"flow bench", {}, {}}, unit{"unit of a type", {}, {}};
  for (const std::string& direction : directions) {
    const OfDirection of(recorded, direction);
    add_force_benches(force, of);
    add_flow_bench(flow, of);
    if (!of.has(Protocol::unpressurised_strokes))
      unit.missing.push_back(of.needed(Protocol::unpressurised_strokes, "where this unit differs from its type"));
  }
  const bool works =
      std::ranges::any_of(recorded, [](const Recorded& each) { return each.protocol == Protocol::operation; });
  const OfDirection first(recorded, directions.front());
  for (ModelNeeds* each : {&force, &flow, &unit}) {
    if (!works)
      each->better.push_back(
          first.needed(Protocol::operation, "friction at rest, moving mass, and how wide the band is"));
  }
  return {force, flow, unit};
}

}  // namespace spoolflow::calibration

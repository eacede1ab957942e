#include "spoolflow/monitor/contact_reading.hpp"

#include <algorithm>

#include "spoolflow/monitor/event_finder.hpp"

namespace spoolflow::monitor {
namespace {

/// Sums over the events of one direction.
struct OneWay {
  double count = 0, apparent_N = 0, believed_N = 0, variance_N2 = 0, off_A = 0, half_width_A = 0;
  void add(const Explained& event, double direction, double believed_N_here) {
    ++count;
    believed_N += believed_N_here;
    apparent_N += direction * event.residual_N + believed_N_here;
    variance_N2 += event.noise_N * event.noise_N;
    off_A += event.current_off_A;
    half_width_A += event.half_width_A;
  }
};

/// Both directions of one region.
struct Region {
  OneWay opening, closing;
  [[nodiscard]] bool identified() const {
    return opening.count >= least_region_events && closing.count >= least_region_events;
  }
};

std::size_t region_of(double position_m, double stroke_m) {
  const double share = (position_m / stroke_m - lowest_event_share) / (highest_event_share - lowest_event_share);
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(friction_regions);
  return std::min(static_cast<std::size_t>(place), friction_regions - 1);
}

Weighted ratio_of(const Region& region) {
  const OneWay &o = region.opening, &c = region.closing;
  const double believed_N = o.believed_N / o.count + c.believed_N / c.count;
  if (!(believed_N > 0)) return {};
  const double variance_N2 = o.variance_N2 / (o.count * o.count) + c.variance_N2 / (c.count * c.count);
  return {(o.apparent_N / o.count + c.apparent_N / c.count) / believed_N, believed_N * believed_N / variance_N2};
}

void mean(Weighted& into, double& expected_into, const Weighted& more, double expected) {
  if (!(more.weight > 0)) return;
  const double left = 1 - 1 / contact_memory_windows;
  into.weight = into.weight * left + more.weight;
  const double share = more.weight / into.weight;
  into.value += share * (more.value - into.value);
  expected_into += share * (expected - expected_into);
}

/// Strokes up to this speed [share of the stroke a second] have the calibrated friction. Faster ones have less, as
/// contacts age while they slide, some valves' more than others': by so much a doubling and no more than that, with one
/// standard deviation about it, all in usual_fault.
constexpr double calibrated_speed_1_s = 0.07;
constexpr double friction_a_doubling = 0.1;
constexpr double unknown_a_doubling = 0.12;
constexpr double most_doublings = 3;
/// Events give a speed where they lie in one stroke: no further apart in time, no nearer in position.
constexpr double longest_between_s = 4;
constexpr double shortest_between_share = 0.01;
constexpr std::size_t least_speeds = 3;

/// Median speed of the travel between neighbouring events [share of the stroke a second]; 0 where there are too few.
double stroke_speed_1_s(const WindowState& window, double stroke_m) {
  std::array<double, window_events> speed_1_s{};
  std::size_t count = 0;
  for (std::size_t k = 1; k < window.count; ++k) {
    const ForceEvent &from = window.events[k - 1], &to = window.events[k];
    const double time_s = to.time_s - from.time_s;
    const double way = to.direction * (to.position_m - from.position_m) / stroke_m;
    if (from.direction == to.direction && time_s > 0 && time_s < longest_between_s && way > shortest_between_share)
      speed_1_s[count++] = way / time_s;
  }
  if (count < least_speeds) return 0;
  const auto middle = speed_1_s.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(speed_1_s.begin(), middle, speed_1_s.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

}  // namespace

ContactReading read_contacts(const sensor::ObserverParameters<double>& valve, double stroke_m,
                             const WindowState& window, double pressure_difference_Pa) {
  std::array<Region, friction_regions> friction{}, width{};
  ContactReading out;
  double breaks = 0, all = 0, breakaway_N = 0, expected_N = 0, variance_N2 = 0, events = 0;
  for (std::size_t k = 0; k < window.count; ++k) {
    const ForceEvent& event = window.events[k];
    const Explained explained = explain(valve, stroke_m, event, pressure_difference_Pa);
    const auto put = [&](std::array<Region, friction_regions>& into, double believed_N) {
      Region& region = into[region_of(event.position_m, stroke_m)];
      (event.direction > 0 ? region.opening : region.closing).add(explained, event.direction, believed_N);
    };
    put(width, 0);
    if (event.kind == EventKind::dithered) continue;
    const double believed_N = valve.friction.operation_ratio * explained.friction_limit_N;
    put(friction, believed_N);
    all += event.count;
    if (event.kind != EventKind::breakaway) continue;
    breaks += event.count;
    breakaway_N += event.direction * explained.residual_N + believed_N;
    expected_N += believed_N;
    variance_N2 += explained.noise_N * explained.noise_N;
    ++events;
  }
  double ratios_A = 0;
  for (std::size_t k = 0; k < friction_regions; ++k) {
    if (friction[k].identified()) out.friction_ratio[k] = ratio_of(friction[k]);
    const OneWay &o = width[k].opening, &c = width[k].closing;
    if (!width[k].identified()) continue;
    out.width_A.value += o.off_A / o.count - c.off_A / c.count;
    out.width_expected_A += o.half_width_A / o.count + c.half_width_A / c.count;
    ++ratios_A;
  }
  if (ratios_A > 0) {
    out.width_A.value /= ratios_A;
    out.width_expected_A /= ratios_A;
    constexpr double width_scatter_share =
        0.1;  // of a window's width about the model's: the loop depends on its history
    out.width_A.weight = ratios_A / std::pow(width_scatter_share * std::max(out.width_expected_A, 1e-3), 2);
  }
  if (all > 0) {
    const double share = breaks / all;
    out.stick_share = {share, all / std::max(share * (1 - share), 0.5 / all)};
  }
  if (events > 0) {
    out.breakaway_N = {breakaway_N / events, events * events / variance_N2};
    out.breakaway_expected_N = expected_N / events;
  }
  return out;
}

SpeedEffect friction_by_speed(const WindowState& window, double stroke_m) {
  const double faster = std::max(stroke_speed_1_s(window, stroke_m) / calibrated_speed_1_s, 1.0);
  const double doublings = std::min(std::log2(faster), most_doublings);
  return {friction_a_doubling * doublings, unknown_a_doubling * doublings};
}

void learn(Contacts& contacts, const ContactReading& reading) {
  double none = 0;
  ContactReading& all = contacts.mean;
  for (std::size_t k = 0; k < friction_regions; ++k) mean(all.friction_ratio[k], none, reading.friction_ratio[k], 0);
  mean(all.breakaway_N, all.breakaway_expected_N, reading.breakaway_N, reading.breakaway_expected_N);
  mean(all.stick_share, none, reading.stick_share, 0);
  mean(all.width_A, all.width_expected_A, reading.width_A, reading.width_expected_A);
}

}  // namespace spoolflow::monitor

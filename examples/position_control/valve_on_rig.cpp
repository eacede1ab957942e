/// What the firmware's electronics are built into: two amplifiers, the instruments and the valve of the virtual rig, in
/// closed loop with the firmware over two pipes. Prints, phase by phase, what flowed and what the sensor answered.
///
///     valve_on_rig SAMPLES ANSWERS
///
/// Exit status 1 where the firmware did not do what docs/embedded.md promises of it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "examples/position_control/wire.hpp"
#include "spoolflow/rig/bench/virtual_campaign.hpp"
#include "spoolflow/rig/electronics/electronics.hpp"
#include "spoolflow/rig/instruments/coil_panel.hpp"
#include "spoolflow/rig/plant/solenoid.hpp"

namespace {

using namespace spoolflow;

constexpr double oil_C = 50;
constexpr double kelvin = 273.15;
constexpr int periods_a_sample = 10;
constexpr double L_per_min = 6e4;  ///< in a m3/s

constexpr double most_flow_L_per_min = 33;  ///< what the machine can bear, see valve_control.hpp
/// The control integrates towards that by the band's end: a supply that rises is followed so much late.
constexpr double most_overshoot_L_per_min = 2.5;
constexpr double most_error_L_per_min = 1;  ///< 1.7 % of the rated flow, where nothing is wrong
constexpr double least_inside_percent = 95;
constexpr double centred_m = 20e-6;
constexpr double settling_s = 0.3;

/// What the machine asks for and what happens meanwhile, until `until_s`; and what the firmware is to make of it.
struct Phase {
  const char* what;
  double until_s;
  double set_m;
  double pressure_difference_bar;
  std::uint32_t page;         ///< at work in the end
  std::uint32_t trust;        ///< worst, see valve_control.hpp
  Event event = Event::none;  ///< as it begins
  bool position_missing = false;
  double position_off_m = 0;  ///< a fault of the acquisition
};

constexpr std::array<Phase, 11> phases{{
    {"closed", 0.3, 0, 40, 1, 0},
    {"opens P to B", 2.0, 1.2e-3, 40, 1, 0},
    {"a newer calibration comes in", 4.0, 1.2e-3, 40, 2, 0, Event::newer_page},
    {"2 mm wanted, 70 bar", 6.0, 2.0e-3, 70, 2, 0},
    {"opens P to A", 8.0, -1.2e-3, 40, 2, 0},
    {"no position for 10 ms", 8.01, -1.2e-3, 40, 2, 3, Event::none, true},
    {"position back", 9.0, -1.2e-3, 40, 2, 0},
    {"position reads 0.3 mm off", 9.1, -1.2e-3, 40, 2, 2, Event::none, false, 0.3e-3},
    {"position right again", 12.0, -1.2e-3, 40, 2, 0},
    {"a bit falls in the page at work", 15.0, -1.2e-3, 40, 1, 1, Event::bit_falls},
    {"no position for good", 15.5, -1.2e-3, 40, 1, 3, Event::none, true},
}};

/// Of one phase, its settling left out: errors of the flow rate [L/min], and the status.
struct Figures {
  int samples = 0, inside = 0;
  double truth = 0, answer = 0, largest_error = 0, largest_flow = 0, dithered = 0;
  std::uint32_t worst_trust = 0, last_page = 0;
};

/// The valve with its amplifiers and instruments.
class Surroundings {
 public:
  Surroundings()
      : valve_(rig::as_built(rig::read_valve_and_campaign("whole_size_6").valve)),
        panel_a_(valve_.instruments, 1, " a"),
        panel_b_(valve_.instruments, 1, " b"),
        noise_(1, "current sensing of the electronics") {
    valve_.plant.load.kind = rig::LoadKind::held_path;
    input_.oil_temperature_C = oil_C;
    state_ = rig::plant_at_rest(valve_.plant, input_);
    lvdt_.emplace(valve_.instruments.lvdt, 1, state_.position_m, oil_C);
  }

  /// One millisecond.
  void obey(const Ordered& orders, double pressure_difference_bar) {
    input_.held_pressure_difference_Pa = 1e5 * pressure_difference_bar;
    const rig::Dither dither{.amplitude_A = orders.dither_amplitude_A, .frequency_Hz = orders.dither_frequency_Hz};
    for (int k = 0; k < periods_a_sample; ++k) {
      turns_ += dither.frequency_Hz * rig::electronics_period_s;
      const double tremble_A = dither.amplitude_A * rig::dither_wave(dither.shape, turns_);
      const double a_A = rig::winding_current_A(valve_.plant.solenoid_a, state_.solenoid_a);
      const double b_A = rig::winding_current_A(valve_.plant.solenoid_b, state_.solenoid_b);
      input_.voltage_a_V = drive(stage_a_, orders.current_a_A, tremble_A, a_A);
      input_.voltage_b_V = drive(stage_b_, orders.current_b_A, tremble_A, b_A);
      rig::step(valve_.plant, state_, input_, rig::electronics_period_s);
      lvdt_->follow(state_.position_m, oil_C, rig::electronics_period_s);
      panel_a_.follow(rig::winding_current_A(valve_.plant.solenoid_a, state_.solenoid_a), input_.voltage_a_V);
      panel_b_.follow(rig::winding_current_A(valve_.plant.solenoid_b, state_.solenoid_b), input_.voltage_b_V);
    }
    panel_a_.end_period(periods_a_sample);
    panel_b_.end_period(periods_a_sample);
  }

  [[nodiscard]] Measured measured(double time_s, const Phase& phase) {
    const double position_m = lvdt_->acquired_m(time_s) + phase.position_off_m;
    const auto single = [](double value) { return static_cast<float>(value); };
    return {.set_position_m = single(phase.set_m),
            .current_a_A = single(panel_a_.current_A()),
            .current_b_A = single(panel_b_.current_A()),
            .voltage_a_V = single(panel_a_.voltage_V()),
            .voltage_b_V = single(panel_b_.voltage_V()),
            .position_m = phase.position_missing ? std::numeric_limits<float>::quiet_NaN() : single(position_m),
            .oil_temperature_K = single(oil_C + kelvin),
            .event = Event::none};
  }
  [[nodiscard]] double flow_L_per_min() const {
    return L_per_min * rig::observe(valve_.plant, state_, input_).path.flow_m3_per_s;
  }
  [[nodiscard]] double position_m() const { return state_.position_m; }

 private:
  double drive(rig::CurrentControlState& stage, double set_A, double tremble_A, double current_A) {
    const double signal_A = current_A + valve_.electronics.current_noise_A * noise_.normal();
    return set_A > 0
               ? rig::step(valve_.electronics.current, stage, set_A + tremble_A, signal_A, rig::electronics_period_s)
               : rig::release(valve_.electronics.current, stage, signal_A);
  }

  rig::ValveUnderTest valve_;
  rig::PlantInput input_;
  rig::PlantState state_;
  std::optional<rig::LvdtReading> lvdt_;
  rig::CoilPanel panel_a_, panel_b_;
  rig::Noise noise_;
  rig::CurrentControlState stage_a_, stage_b_;
  double turns_ = 0;
};

/// The firmware at the other end of the pipes.
class Firmware {
 public:
  Firmware(const std::string& samples, const std::string& answers) {
    samples_.open(samples, std::ios::binary);
    answers_.open(answers, std::ios::binary);
    if (!samples_ || !answers_) throw std::runtime_error("the pipes cannot be opened");
  }
  Ordered answer(const Measured& sample) {
    samples_.write(reinterpret_cast<const char*>(&sample), sizeof sample).flush();
    Ordered orders{};
    if (!answers_.read(reinterpret_cast<char*>(&orders), sizeof orders))
      throw std::runtime_error("the firmware answers no more");
    return orders;
  }

 private:
  std::ofstream samples_;
  std::ifstream answers_;
};

void note(Figures& figures, const Ordered& orders, double flow, bool settled) {
  figures.last_page = orders.page;
  if (settled) figures.largest_flow = std::max(figures.largest_flow, std::abs(flow));
  if (orders.page == 0 || settled) figures.worst_trust = std::max(figures.worst_trust, orders.trust);
  if (orders.page == 0 || !settled) return;
  const double answer = L_per_min * orders.flow_m3_per_s;
  ++figures.samples;
  figures.truth += flow;
  figures.answer += answer;
  figures.dithered += orders.dither_amplitude_A > 0 ? 1 : 0;
  figures.largest_error = std::max(figures.largest_error, std::abs(answer - flow));
  figures.inside +=
      L_per_min * orders.flow_lower_m3_per_s <= flow && flow <= L_per_min * orders.flow_upper_m3_per_s ? 1 : 0;
}

double percent(const Figures& figures, double count) {
  return 100 * count / std::max(1, figures.samples);
}

void print(const Phase& phase, const Figures& figures) {
  const double samples = std::max(1, figures.samples);
  fmt::print("{:<32}{:>8.1f}{:>8.1f}{:>8.1f}{:>9.0f}{:>9.1f}{:>10.0f}{:>7}{:>6}\n", phase.what, figures.truth / samples,
             figures.answer / samples, figures.largest_error, percent(figures, figures.inside), figures.largest_flow,
             percent(figures, figures.dithered), figures.worst_trust, figures.last_page);
}

/// Throws std::runtime_error with what is not as promised.
void expect(const Phase& phase, const Figures& figures) {
  const auto demand = [&](bool met, const char* what) {
    if (!met) throw std::runtime_error(fmt::format("\"{}\": {}", phase.what, what));
  };
  demand(figures.samples > 0, "the sensor did not answer");
  demand(figures.last_page == phase.page, "another page is at work than should be");
  demand(figures.worst_trust == phase.trust, "the sensor's status was taken otherwise than it should be");
  demand(figures.largest_flow < most_flow_L_per_min + most_overshoot_L_per_min, "more flows than the machine can bear");
  if (phase.trust > 1) return;
  // The sensor has not seen the valve for a while, and when the spool slips next is a matter of chance.
  const double restart_factor = phase.trust == 0 ? 1 : 4;
  demand(figures.largest_error < restart_factor * most_error_L_per_min,
         "the answer is further from the truth than it should be");
  demand(percent(figures, figures.inside) > least_inside_percent, "the truth is outside the band");
}

/// Where the spool stands in the end [m].
double run(Firmware& firmware, std::array<Figures, phases.size()>& figures) {
  Surroundings surroundings;
  Ordered orders{};
  int sample = 0;
  double begin_s = 0;
  for (std::size_t k = 0; k < phases.size(); ++k) {
    const Phase& phase = phases[k];
    const double settled_s = phase.until_s - begin_s > 2 * settling_s ? begin_s + settling_s : begin_s;
    Event event = phase.event;
    for (double time_s = 1e-3 * sample; time_s < phase.until_s - 1e-9; time_s = 1e-3 * ++sample) {
      surroundings.obey(orders, phase.pressure_difference_bar);
      Measured measured = surroundings.measured(time_s, phase);
      measured.event = event;
      event = Event::none;
      orders = firmware.answer(measured);
      note(figures[k], orders, surroundings.flow_L_per_min(), time_s >= settled_s);
    }
    begin_s = phase.until_s;
  }
  return surroundings.position_m();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: valve_on_rig SAMPLES ANSWERS\n");
    return 2;
  }
  try {
    Firmware firmware(argv[1], argv[2]);
    std::array<Figures, phases.size()> figures{};
    const double end_m = run(firmware, figures);
    fmt::print("{:<32}{:>8}{:>8}{:>8}{:>9}{:>9}{:>10}{:>7}{:>6}\n", "flow rate [L/min]", "true", "answer", "error",
               "inside %", "largest", "dither %", "trust", "page");
    for (std::size_t k = 0; k < phases.size(); ++k) print(phases[k], figures[k]);
    fmt::print("spool at the end: {:.3f} mm from the centre\n", 1e3 * std::abs(end_m));
    std::fflush(stdout);
    for (std::size_t k = 0; k < phases.size(); ++k) expect(phases[k], figures[k]);
    if (std::abs(end_m) > centred_m) throw std::runtime_error("the springs have not centred the spool");
  } catch (const std::exception& error) {
    fmt::print(stderr, "valve_on_rig: {}\n", error.what());
    return 1;
  }
  return 0;
}

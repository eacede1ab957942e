#include "spoolflow/rig/bench/virtual_campaign.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>

#include <fmt/format.h>

#include "spoolflow/parallel/for_each.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::rig {
namespace {

/// Each recording has its own noise, whatever else the campaign holds.
std::uint64_t seed_of(const ValveUnderTest& valve, std::string_view file) {
  Noise noise(valve.seed, std::string("recording ").append(file));
  return static_cast<std::uint64_t>(noise.uniform() * 0x1p52);
}

class Items {
 public:
  explicit Items(const ValveUnderTest& valve) : valve_(as_built(valve)) {}

  void add(std::string file, std::string protocol, Protocol settings) {
    add_with(valve_, std::move(file), std::move(protocol), std::move(settings));
  }
  void add_with(ValveUnderTest valve, std::string file, std::string protocol, Protocol settings) {
    const std::uint64_t seed = seed_of(valve_, file);
    items_.push_back({.file = std::move(file),
                      .protocol = std::move(protocol),
                      .settings = std::move(settings),
                      .valve = std::move(valve),
                      .seed = seed});
  }
  [[nodiscard]] const ValveUnderTest& valve() const { return valve_; }
  std::vector<CampaignItem> take() { return std::move(items_); }

 private:
  ValveUnderTest valve_;
  std::vector<CampaignItem> items_;
};

void add_calibration(Items& items, const CampaignSettings& settings) {
  items.add("spring.csv", "spring", protocol_named("spring"));
  items.add("solenoid_map.csv", "solenoid_force_map", protocol_named("solenoid_force_map"));
  items.add("solenoid_dynamic.csv", "solenoid_dynamic", protocol_named("solenoid_dynamic"));
  for (const double temperature_C : settings.oil_temperatures_C) {
    items.add(fmt::format("axial_force_map_{:g}.csv", temperature_C), "axial_force_map",
              AxialForceProtocol{.pressure_differences_bar = settings.pressure_differences_bar,
                                 .oil_temperature_C = temperature_C});
  }
  items.add(fmt::format("ramp_{:g}bar.csv", settings.ramp_pressure_bar), "operation",
            RampsProtocol{.conditions = {}, .pressure_differences_bar = {settings.ramp_pressure_bar}});
}

/// As the campaign dithers it, where its electronics have no dither of their own.
ValveUnderTest dithered(ValveUnderTest valve, const CampaignSettings& settings) {
  if (valve.electronics.dither.amplitude_A == 0) {
    valve.electronics.dither.amplitude_A = settings.dither_amplitude_A;
    valve.electronics.dither.frequency_Hz = settings.dither_frequency_Hz;
  }
  return valve;
}

/// A load that a valve of this rating can feed: fully open, a quarter of the supply pressure is left over its edge.
/// What comes back from the load goes straight to tank: the bench has measured the edge P to B alone.
ValveUnderTest loaded(ValveUnderTest valve, LoadKind kind, double supply_bar) {
  constexpr double turned_rad_per_s = 105;  // 1000 turns a minute at rated flow
  constexpr double torque_share = 0.4;      // of what the supply pressure could hold
  constexpr double run_up_s = 0.1;          // with what is left of it
  constexpr double discharge = 0.7;         // that of load.hpp
  const double supply_Pa = units::Pa_from_bar(supply_bar);
  const double rated_m3_per_s = units::m3_per_s_from_L_per_min(valve.rating.flow_L_per_min);
  const double edge = rated_m3_per_s / std::sqrt(units::Pa_from_bar(valve.rating.pressure_difference_bar));
  Load& load = valve.plant.load;
  load.kind = kind;
  load.return_to_tank = true;
  load.orifice_area_m2 = edge / std::sqrt(3.0) / discharge * std::sqrt(0.5 * valve.plant.oil.density_15C_kg_per_m3);
  load.motor_displacement_m3_per_rad = rated_m3_per_s / turned_rad_per_s;
  load.motor_torque_N_m = torque_share * supply_Pa * load.motor_displacement_m3_per_rad;
  load.motor_inertia_kg_m2 =
      (1 - torque_share) * supply_Pa * load.motor_displacement_m3_per_rad * run_up_s / turned_rad_per_s;
  load.motor_drag_N_m_s = 0.05 * load.motor_torque_N_m / turned_rad_per_s;
  return valve;
}

/// One dithered duty cycle under each kind of load.
void add_dithered_duty(Items& items, const CampaignSettings& settings) {
  const ValveUnderTest valve = dithered(items.valve(), settings);
  const double supply_bar =
      *std::max_element(settings.pressure_differences_bar.begin(), settings.pressure_differences_bar.end());
  const DutyCycleProtocol held{.conditions = {}, .duration_s = settings.dithered_duty_s};
  DutyCycleProtocol fed = held;
  fed.conditions.supply_pressure_bar = supply_bar;  // the difference never leaves the calibrated range
  items.add_with(valve, "duty_dither.csv", "", held);
  items.add_with(loaded(valve, LoadKind::orifice, supply_bar), "orifice_duty_dither.csv", "", fed);
  items.add_with(loaded(valve, LoadKind::motor, supply_bar), "motor_duty_dither.csv", "", fed);
}

}  // namespace

ValveAndCampaign read_valve_and_campaign(const std::string& valve) {
  ValveAndCampaign asked;
  Settings campaign;
  campaign.add("campaign", asked.campaign);
  asked.valve = valve.ends_with(".toml") ? read_valve(valve, campaign) : valve_preset(valve, campaign);
  return asked;
}

std::vector<CampaignItem> calibration_items(const ValveUnderTest& valve, const CampaignSettings& settings) {
  Items items(valve);
  add_calibration(items, settings);
  return items.take();
}

std::vector<CampaignItem> campaign_items(const ValveUnderTest& valve, const CampaignSettings& settings) {
  Items items(valve);
  add_calibration(items, settings);
  const auto& ramps_bar = settings.ramps_pressures_bar;
  items.add(fmt::format("ramps_{:g}_to_{:g}bar.csv", ramps_bar.front(), ramps_bar.back()), "",
            RampsProtocol{.conditions = {.position_faults_per_s = settings.ramps_position_faults_per_s},
                          .pressure_differences_bar = ramps_bar});
  items.add("duty_cycle_1.csv", "", DutyCycleProtocol{.conditions = {}, .duration_s = settings.duty_cycle_s});
  auto sweep = std::get<RampsProtocol>(protocol_named("temperature_sweep"));
  std::fill(sweep.pressure_differences_bar.begin(), sweep.pressure_differences_bar.end(), settings.sweep_pressure_bar);
  items.add("temperature_sweep.csv", "", sweep);
  items.add("pressure_steps.csv", "", protocol_named("pressure_steps"));
  items.add("sine_sweep.csv", "",
            SineProtocol{.conditions = {},
                         .frequency_end_Hz = settings.sweep_frequency_Hz,
                         .pressure_difference_bar = settings.sweep_pressure_bar});
  items.add_with(dithered(items.valve(), settings), "dither.csv", "",
                 RampsProtocol{.conditions = {}, .pressure_differences_bar = {settings.ramp_pressure_bar}});
  items.add("fast_motion.csv", "", protocol_named("fast_motion"));
  add_dithered_duty(items, settings);
  return items.take();
}

std::string campaign_text(const ValveUnderTest& valve, const std::vector<CampaignItem>& items) {
  const Oil& oil = valve.plant.oil;
  std::string text = fmt::format(
      R"(# What was measured on this virtual valve, for calibration. Channels follow the <channel>_<unit> naming,
# so no [recording.channels] tables are needed. Simulated; seed {seed}.
[valve]
name = "{name}"
rated_flow_L_min = {flow:.1f}      # full scale of every % FS figure
stroke_mm = {stroke:g}

[fluid]
name = "{fluid}"
density_15C_kg_per_m3 = {density:.1f}
viscosity_40C_mm2_per_s = {viscosity_40:.1f}
viscosity_100C_mm2_per_s = {viscosity_100:.1f}
)",
      fmt::arg("seed", valve.seed), fmt::arg("name", valve.name), fmt::arg("flow", valve.rating.flow_L_per_min),
      fmt::arg("stroke", units::mm_from_m(valve.plant.spool.stroke_m)), fmt::arg("fluid", valve.fluid),
      fmt::arg("density", oil.density_15C_kg_per_m3), fmt::arg("viscosity_40", 1e6 * oil.viscosity_40C_m2_per_s),
      fmt::arg("viscosity_100", 1e6 * oil.viscosity_100C_m2_per_s));
  for (const CampaignItem& item : items) {
    if (item.protocol.empty()) {
      continue;
    }
    if (item.protocol == "operation") {
      text +=
          "\n# One operating run with its reference meter: it shows what no bench test does (stiction, pre-sliding), "
          "so\n"
          "# figures on this run are not held-out figures.";
    }
    text += fmt::format("\n[[recording]]\nprotocol = \"{}\"\nfile = \"{}\"\n", item.protocol, item.file);
  }
  return text;
}

void run_campaign(const std::vector<CampaignItem>& items, const CampaignWork& work) {
  std::vector<BenchRun> runs;
  double total_s = 0;
  for (const CampaignItem& item : items) {
    runs.push_back(plan(item.settings, item.valve, item.seed));
    total_s += runs.back().duration_s();
  }
  std::vector<std::size_t> order(items.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t one, std::size_t two) { return runs[one].duration_s() > runs[two].duration_s(); });

  std::mutex mutex;  // guards progress and shares
  std::vector<double> shares(items.size(), 0.0);
  std::atomic<bool> stop{false};
  struct Stopped {};

  const auto simulate_item = [&](std::size_t index) {
    const double weight = runs[index].duration_s() / total_s;
    const auto report = [&](double share) {
      if (stop) {
        throw Stopped{};
      }
      if (work.progress) {
        const std::lock_guard lock(mutex);
        shares[index] = weight * share;
        work.progress(std::accumulate(shares.begin(), shares.end(), 0.0));
      }
    };
    const CampaignItem& item = items[index];
    const Simulation simulation =
        simulate(item.valve, runs[index], item.seed, {.with_truth = work.with_truth, .progress = report});
    work.store(item, runs[index], simulation);
    const std::lock_guard lock(mutex);
    shares[index] = weight;
  };
  parallel::for_each(order.size(), work.workers, [&](std::size_t k) {
    try {
      simulate_item(order[k]);
    } catch (const Stopped&) {
    } catch (...) {
      stop = true;
      throw;
    }
  });
}

}  // namespace spoolflow::rig

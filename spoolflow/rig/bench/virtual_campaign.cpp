#include "spoolflow/rig/bench/virtual_campaign.hpp"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <mutex>
#include <numeric>

#include <fmt/format.h>

#include "spoolflow/parallel/for_each.hpp"
#include "spoolflow/rig/bench/campaign_loads.hpp"
#include "spoolflow/rig/bench/flow_bench_campaign.hpp"
#include "spoolflow/rig/bench/whole_campaign.hpp"
#include "spoolflow/rig/plants/plant_group.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::rig {
namespace {

std::string ramp_file(const CampaignSettings& settings) {
  return fmt::format("ramp_{:g}bar.csv", settings.ramp_pressure_bar);
}

RampsProtocol ramp(const CampaignSettings& settings) {
  return {.conditions = {},
          .pressure_differences_bar = {settings.ramp_pressure_bar},
          .rate_percent_per_s = settings.ramp_rate_percent_per_s};
}

void add_calibration(CampaignItems& items, const CampaignSettings& settings) {
  if (settings.bench == CampaignBench::flow) return add_flow_bench(items, settings);
  if (items.valve().whole) return add_whole_calibration(items, settings);
  items.add("spring.csv", "spring", protocol_named("spring"));
  items.add("solenoid_map.csv", "solenoid_force_map", protocol_named("solenoid_force_map"));
  items.add("solenoid_dynamic.csv", "solenoid_dynamic", protocol_named("solenoid_dynamic"));
  for (const double temperature_C : settings.oil_temperatures_C) {
    items.add(fmt::format("axial_force_map_{:g}.csv", temperature_C), "axial_force_map",
              AxialForceProtocol{.pressure_differences_bar = settings.pressure_differences_bar,
                                 .oil_temperature_C = temperature_C});
  }
  items.add(ramp_file(settings), "operation", ramp(settings));
}

/// One dithered duty cycle under each kind of load.
void add_dithered_duty(CampaignItems& items, const CampaignSettings& settings) {
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

/// What campaign.toml says of a whole valve beside its recordings.
std::string of_whole_valve(const ValveUnderTest& valve) {
  std::string text;
  const Load& load = valve.plant.load;
  if (load.kind == LoadKind::cylinder) {
    text += fmt::format("\n[load]\narea_ratio = {:g}             # piston area of port A over that of port B\n",
                        load.piston_area_A_m2 / load.piston_area_B_m2);
  }
  return text +
         "\n# Both directions: b opens P to B, a opens P to A. In bench tests position counts from the centre, opening "
         "> 0;"
         "\n# in operation position and flow > 0 are P to B, and the pressure difference is that of both open edges, "
         "added.\n";
}

constexpr std::string_view campaign_begin = "# What was measured on this virtual valve";

/// Each oil temperature has a recording of its own, named by it.
void require_each_temperature_once(const std::string& valve, std::vector<double> temperatures_C) {
  std::ranges::sort(temperatures_C);
  const auto twice = std::ranges::adjacent_find(temperatures_C);
  if (twice == temperatures_C.end()) return;
  throw SettingsError(
      fmt::format("{}: campaign.oil_temperatures_C has {:g} twice, and both recordings would have one "
                  "name; leave one out, or give another temperature",
                  valve, *twice));
}

}  // namespace

ValveAndCampaign read_valve_and_campaign(const std::string& valve) {
  ValveAndCampaign asked;
  Settings campaign;
  campaign.add("campaign", asked.campaign);
  campaign.add_choice("campaign.bench", {"force", "flow"},
                      [&](std::size_t choice) { asked.campaign.bench = static_cast<CampaignBench>(choice); });
  campaign.add_choice("campaign.edges", {"joined", "one_at_a_time"},
                      [&](std::size_t choice) { asked.campaign.one_edge_at_a_time = choice == 1; });
  asked.valve = valve.ends_with(".toml") ? read_valve(valve, campaign) : valve_preset(valve, campaign);
  require_each_temperature_once(valve, asked.campaign.oil_temperatures_C);
  return asked;
}

std::vector<CampaignItem> calibration_items(const ValveUnderTest& valve, const CampaignSettings& settings) {
  CampaignItems items(valve);
  add_calibration(items, settings);
  return items.take();
}

std::vector<CampaignItem> campaign_items(const ValveUnderTest& valve, const CampaignSettings& settings) {
  CampaignItems items(valve);
  add_calibration(items, settings);
  if (valve.whole) {
    add_whole_validation(items, settings);
    return items.take();
  }
  if (settings.bench == CampaignBench::flow) items.add(ramp_file(settings), "", ramp(settings));
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
  items.add_with(dithered(items.valve(), settings), "dither.csv", "", ramp(settings));
  items.add("fast_motion.csv", "", protocol_named("fast_motion"));
  add_dithered_duty(items, settings);
  return items.take();
}

bool is_virtual_campaign(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  return std::getline(in, line) && line.starts_with(campaign_begin);
}

std::string campaign_text(const ValveUnderTest& valve, const std::vector<CampaignItem>& items) {
  const Oil& oil = valve.plant.oil;
  std::string text = std::string(campaign_begin);
  text += fmt::format(
      R"(, for calibration. Channels follow the <channel>_<unit> naming,
# so no [recording.channels] tables are needed. Simulated; seed {seed}.
[valve]
name = "{name}"
rated_flow_L_min = {flow:.1f}      # full scale of every % FS figure
stroke_mm = {stroke:g}
origin = "simulated"          # reports say so in their headline

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
  text += valve.whole ? of_whole_valve(valve) : tolerances_text(valve.spread, valve.plant);
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
    text += fmt::format("\n[[recording]]\nprotocol = \"{}\"\n", item.protocol);
    if (!item.direction.empty()) text += fmt::format("direction = \"{}\"\n", item.direction);
    if (!item.edge.empty()) text += fmt::format("edge = \"{}\"\n", item.edge);
    text += fmt::format("file = \"{}\"\n", item.file);
  }
  return text;
}

namespace {

/// Items that are simulated at once, by number, longest runs first: no more than leaves work for every worker.
std::vector<std::vector<std::size_t>> items_at_once(const std::vector<CampaignItem>& items,
                                                    const std::vector<BenchRun>& runs, unsigned workers) {
  std::vector<std::size_t> order(items.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t one, std::size_t two) { return runs[one].duration_s() > runs[two].duration_s(); });
  const std::size_t most = std::clamp<std::size_t>(items.size() / (2 * std::max(1U, workers)), 1, plants_at_once());
  std::vector<std::vector<std::size_t>> out;
  const auto fits = [&](const std::vector<std::size_t>& group, std::size_t item) {
    const BenchRun& first = runs[group.front()];
    const LoadKind load = items[item].valve.plant.load.kind;
    const LoadKind first_load = items[group.front()].valve.plant.load.kind;
    return group.size() < most && runs[item].arrangement == first.arrangement &&
           runs[item].load.value_or(load) == first.load.value_or(first_load) &&
           runs[item].duration_s() > 0.7 * first.duration_s();
  };
  for (const std::size_t item : order) {
    const auto group = std::find_if(out.begin(), out.end(), [&](const auto& g) { return fits(g, item); });
    if (group != out.end()) {
      group->push_back(item);
    } else {
      out.push_back({item});
    }
  }
  return out;
}

}  // namespace

void run_campaign(const std::vector<CampaignItem>& items, const CampaignWork& work) {
  std::vector<BenchRun> runs;
  double total_s = 0;
  for (const CampaignItem& item : items) {
    runs.push_back(plan(item.settings, item.valve, item.seed));
    total_s += runs.back().duration_s();
  }
  const std::vector<std::vector<std::size_t>> groups = items_at_once(items, runs, work.workers);

  std::mutex mutex;  // guards progress and shares
  std::vector<double> shares(groups.size(), 0.0);
  std::atomic<bool> stop{false};
  struct Stopped {};

  const auto simulate_group = [&](std::size_t index) {
    double weight = 0;
    std::vector<ValveUnderTest> valves;
    std::vector<BenchRun> at_once;
    std::vector<std::uint64_t> seeds;
    for (const std::size_t item : groups[index]) {
      weight += runs[item].duration_s() / total_s;
      valves.push_back(items[item].valve);
      at_once.push_back(runs[item]);
      seeds.push_back(items[item].seed);
    }
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
    const std::vector<Simulation> simulations =
        simulate_together(valves, at_once, seeds, {.with_truth = work.with_truth, .progress = report});
    for (std::size_t k = 0; k < simulations.size(); ++k) {
      work.store(items[groups[index][k]], at_once[k], simulations[k]);
    }
    const std::lock_guard lock(mutex);
    shares[index] = weight;
  };
  parallel::for_each(groups.size(), work.workers, [&](std::size_t k) {
    try {
      simulate_group(k);
    } catch (const Stopped&) {
    } catch (...) {
      stop = true;
      throw;
    }
  });
}

}  // namespace spoolflow::rig

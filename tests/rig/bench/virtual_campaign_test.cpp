/// A campaign's files are laid out as those of a real bench.
#include "spoolflow/rig/bench/virtual_campaign.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/rig/bench/recording_file.hpp"

namespace spoolflow::rig {
namespace {

std::vector<CampaignItem> default_items() {
  return campaign_items(valve_preset("size_6"), {});
}

std::string header_of(const CampaignItem& item) {
  BenchRun run = plan(item.settings, item.valve, item.seed);
  run.sample_rate_Hz = {{0.01, 1000}};
  std::ostringstream text;
  write_recording(text, simulate(item.valve, run, item.seed).recording, run);
  return text.str().substr(0, text.str().find('\n'));
}

TEST(VirtualCampaign, ColumnsAreThoseOfTheReferenceRecordings) {
  const std::string axial =
      "time_s,pressure_difference_set_bar,pressure_upstream_bar,pressure_downstream_bar,oil_temperature_C,position_mm,"
      "axial_force_N,flow_L_min";
  const std::string operation =
      "time_s,position_set_percent,position_mm,current_A,voltage_V,oil_temperature_C,pressure_difference_bar,"
      "flow_reference_L_min";
  const std::map<std::string, std::string> expected{
      {"spring", axial},
      {"axial_force_map", axial},
      {"solenoid_force_map", "time_s,current_set_A,current_A,voltage_V,position_mm,force_N"},
      {"solenoid_dynamic", "time_s,test,current_A,voltage_V,position_mm,force_N"},
      {"operation", operation},
      {"", operation}};
  for (const CampaignItem& item : default_items()) EXPECT_EQ(header_of(item), expected.at(item.protocol)) << item.file;
}

TEST(VirtualCampaign, HoldsTheBenchTestsOneOperatingRunAndTheValidationRuns) {
  std::vector<std::string> listed, validation;
  for (const CampaignItem& item : default_items()) (item.protocol.empty() ? validation : listed).push_back(item.file);
  EXPECT_THAT(listed,
              testing::ElementsAre("spring.csv", "solenoid_map.csv", "solenoid_dynamic.csv", "axial_force_map_30.csv",
                                   "axial_force_map_50.csv", "axial_force_map_70.csv", "ramp_60bar.csv"));
  EXPECT_THAT(validation, testing::ElementsAre("ramps_30_to_70bar.csv", "duty_cycle_1.csv", "temperature_sweep.csv",
                                               "pressure_steps.csv", "sine_sweep.csv", "dither.csv", "fast_motion.csv",
                                               "duty_dither.csv", "orifice_duty_dither.csv", "motor_duty_dither.csv"));
  const std::string text = campaign_text(valve_preset("size_6"), default_items());
  for (const std::string& file : listed) EXPECT_THAT(text, testing::HasSubstr("file = \"" + file + "\""));
  for (const std::string& file : validation) EXPECT_THAT(text, testing::Not(testing::HasSubstr(file)));
  EXPECT_THAT(text, testing::HasSubstr("protocol = \"operation\"\nfile = \"ramp_60bar.csv\""));
}

TEST(VirtualCampaign, OfAWholeValveMeasuresBothDirectionsAndThenRunsThroughTheCentre) {
  const ValveAndCampaign whole = read_valve_and_campaign("whole_size_6");
  const std::vector<CampaignItem> items = campaign_items(whole.valve, whole.campaign);
  std::vector<std::string> listed, validation;
  for (const CampaignItem& item : items) (item.protocol.empty() ? validation : listed).push_back(item.file);
  EXPECT_THAT(listed, testing::ElementsAre(
                          "spring_b.csv", "solenoid_map_b.csv", "solenoid_dynamic_b.csv", "axial_force_map_30_b.csv",
                          "axial_force_map_50_b.csv", "axial_force_map_70_b.csv", "spring_a.csv", "solenoid_map_a.csv",
                          "solenoid_dynamic_a.csv", "axial_force_map_30_a.csv", "axial_force_map_50_a.csv",
                          "axial_force_map_70_a.csv", "both_ramps_60bar.csv"));
  EXPECT_THAT(validation,
              testing::ElementsAre("both_ramps_30_to_70bar.csv", "both_duty_1.csv", "both_temperature_sweep.csv",
                                   "both_pressure_steps.csv", "both_sine_sweep.csv", "both_fast_motion.csv",
                                   "both_duty_dither.csv", "both_orifice_dither.csv", "both_overrunning.csv",
                                   "both_regenerative.csv"));
  const std::string text = campaign_text(whole.valve, items);
  EXPECT_THAT(text, testing::HasSubstr("protocol = \"spring\"\ndirection = \"a\"\nfile = \"spring_a.csv\""));
  EXPECT_THAT(text, testing::HasSubstr("protocol = \"operation\"\nfile = \"both_ramps_60bar.csv\""));
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("area_ratio")));

  const std::string operation =
      "time_s,position_set_percent,position_mm,current_a_A,current_b_A,voltage_a_V,voltage_b_V,oil_temperature_C,"
      "pressure_difference_bar,flow_reference_L_min";
  for (const CampaignItem& item : items) {
    if (item.file == "both_ramps_60bar.csv") {
      EXPECT_EQ(header_of(item), operation);
    }
    if (item.file == "both_overrunning.csv") {
      EXPECT_EQ(header_of(item), operation + ",pressure_p_bar,pressure_a_bar,pressure_b_bar,pressure_t_bar");
    }
    if (item.file == "spring_a.csv") {
      EXPECT_EQ(item.valve.plant.spring_b.preload_N, whole.valve.plant.spring_a.preload_N);
    }
  }
}

TEST(VirtualCampaign, OfAWholeValveNamesItsCylinderAndTheEdgesMeasuredOneAtATime) {
  ValveAndCampaign whole = read_valve_and_campaign("whole_differential");
  whole.campaign.one_edge_at_a_time = true;
  const std::vector<CampaignItem> items = calibration_items(whole.valve, whole.campaign);
  const std::string text = campaign_text(whole.valve, items);
  EXPECT_THAT(text, testing::HasSubstr("[load]\narea_ratio = 0.6"));
  for (const auto& [edge, direction] : {std::pair{"PB", "b"}, {"AT", "b"}, {"PA", "a"}, {"BT", "a"}}) {
    EXPECT_THAT(text, testing::HasSubstr(std::string("direction = \"") + direction + "\"\nedge = \"" + edge +
                                         "\"\nfile = \"axial_force_map_50_" + edge + ".csv\""));
  }
}

TEST(VirtualCampaign, OnAFlowBenchMovesTheValveByItsOwnSolenoidAlone) {
  const CampaignSettings settings{.bench = CampaignBench::flow};
  const std::vector<CampaignItem> items = calibration_items(valve_preset("size_6"), settings);
  std::vector<std::string> files;
  for (const CampaignItem& item : items) {
    files.push_back(item.file);
    EXPECT_EQ(header_of(item),
              "time_s,position_set_percent,position_mm,current_A,voltage_V,oil_temperature_C,pressure_difference_bar,"
              "flow_reference_L_min")
        << item.file;
  }
  EXPECT_THAT(files, testing::ElementsAre("unpressurised.csv", "metering_30.csv", "metering_50.csv", "metering_70.csv",
                                          "random_moves.csv"));
  const std::vector<CampaignItem> all = campaign_items(valve_preset("size_6"), settings);
  EXPECT_TRUE(std::ranges::any_of(all, [](const CampaignItem& item) { return item.file == "ramp_60bar.csv"; }))
      << "the ramp judges";
}

TEST(VirtualCampaign, OnAFlowBenchStrokesBothWaysAtEachPressureDifference) {
  const ValveUnderTest valve = as_built(valve_preset("size_6"));
  FlowBenchProtocol protocol{.pressure_differences_bar = {0, 40}, .rate_percent_per_s = 80, .hold_s = 0.3};
  const Protocol settings = protocol;
  const recording::Recording recording = simulate(valve, plan(settings, valve, 1), 1).recording;
  using recording::Channel;
  double widest_m[2] = {}, largest_flow[2] = {};
  for (std::size_t k = 0; k < recording.size(); ++k) {
    const int level = 2 * k < recording.size() ? 0 : 1;
    widest_m[level] = std::max(widest_m[level], recording[Channel::position][k]);
    largest_flow[level] = std::max(largest_flow[level], recording[Channel::flow_reference][k]);
  }
  for (const double widest : widest_m) EXPECT_NEAR(widest, 2.4e-3, 0.05e-3);
  EXPECT_LT(largest_flow[0] * 6e4, 1) << "the pump is off";
  EXPECT_GT(largest_flow[1] * 6e4, 40);
  EXPECT_NEAR(recording[Channel::pressure_difference].front() / 1e5, 0, 0.5);
  EXPECT_NEAR(recording[Channel::pressure_difference].back() / 1e5, 40, 1);
}

TEST(VirtualCampaign, OfAWholeValveOnAFlowBenchMeasuresEachDirectionWithItsOwnSolenoid) {
  ValveAndCampaign whole = read_valve_and_campaign("whole_size_6");
  whole.campaign.bench = CampaignBench::flow;
  whole.campaign.oil_temperatures_C = {50};
  std::vector<std::string> files;
  for (const CampaignItem& item : calibration_items(whole.valve, whole.campaign)) {
    files.push_back(item.file);
    if (item.file != "metering_50_a.csv") continue;
    FlowBenchProtocol fast = std::get<FlowBenchProtocol>(item.settings);
    fast.pressure_differences_bar = {50};
    fast.rate_percent_per_s = 80;
    fast.hold_s = 0.2;
    const recording::Recording run =
        simulate(item.valve, plan(Protocol(fast), item.valve, item.seed), item.seed).recording;
    const auto largest = [&](recording::Channel channel) { return *std::ranges::max_element(run.column(channel)); };
    EXPECT_NEAR(largest(recording::Channel::position), 2.4e-3, 0.05e-3) << "opening counts > 0 either way";
    EXPECT_GT(largest(recording::Channel::current), 0.8);
    EXPECT_GT(largest(recording::Channel::flow_reference) * 6e4, 35);
  }
  EXPECT_THAT(files, testing::ElementsAre("unpressurised_b.csv", "metering_50_b.csv", "unpressurised_a.csv",
                                          "metering_50_a.csv", "both_random_moves.csv"));
  whole.campaign.one_edge_at_a_time = true;
  const std::string text = campaign_text(whole.valve, calibration_items(whole.valve, whole.campaign));
  EXPECT_THAT(text, testing::HasSubstr("protocol = \"metering\"\ndirection = \"b\"\nedge = \"AT\""));
}

/// Two short recordings with different noise.
std::vector<CampaignItem> short_items() {
  CampaignItem item{.file = "steps.csv",
                    .protocol = "",
                    .settings = StepsProtocol{.conditions = {}, .positions_percent = {60}, .hold_s = 0.2},
                    .valve = valve_preset("size_6"),
                    .seed = 1};
  std::vector<CampaignItem> items{item, item};
  items.back().file = "again.csv";
  items.back().seed = 2;
  return items;
}

TEST(VirtualCampaign, DoesNotDependOnTheNumberOfWorkers) {
  const std::vector<CampaignItem> items = short_items();
  const auto recordings = [&](unsigned workers) {
    std::map<std::string, std::string> files;
    std::mutex mutex;
    run_campaign(items, {.store =
                             [&](const CampaignItem& item, const BenchRun& run, const Simulation& simulation) {
                               std::ostringstream text;
                               write_recording(text, simulation.recording, run);
                               const std::lock_guard lock(mutex);
                               files[item.file] = text.str();
                             },
                         .workers = workers});
    return files;
  };
  const auto one = recordings(1);
  EXPECT_EQ(recordings(2), one);
  EXPECT_NE(one.at("steps.csv"), one.at("again.csv"));
}

TEST(VirtualCampaign, ReportsProgressThatNeverRunsBackwards) {
  double last = 0;
  int calls = 0;
  run_campaign(short_items(), {.store = [](const auto&, const auto&, const auto&) {},
                               .progress =
                                   [&](double share) {
                                     EXPECT_GE(share, last);
                                     EXPECT_LE(share, 1.0 + 1e-9);
                                     last = share;
                                     ++calls;
                                   }});
  EXPECT_GT(calls, 100);
  EXPECT_GT(last, 0.98);
}

TEST(VirtualCampaign, RefusesAnOilTemperatureThatIsNamedTwice) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "twice.toml";
  std::ofstream(file) << "preset = \"size_6\"\n[campaign]\noil_temperatures_C = [30, 50, 30]\n";
  try {
    (void)read_valve_and_campaign(file.string());
    FAIL() << "read";
  } catch (const SettingsError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("twice.toml: campaign.oil_temperatures_C has 30 twice"));
  }
}

TEST(VirtualCampaign, StopsAtTheFirstFailure) {
  EXPECT_THROW(run_campaign(short_items(), {.store = [](const auto&, const auto&,
                                                        const auto&) { throw std::runtime_error("disk full"); }}),
               std::runtime_error);
}

}  // namespace
}  // namespace spoolflow::rig

/// `spoolflow estimate` over recordings whose coil signals broke in between.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Row {
  double flow_L_min, lower_L_min, upper_L_min;
  std::string status;
};

class EstimateFaults : public CommandLine {
 protected:
  /// Strokes of the example's valve; `broken` is what amplifier and line make of 0.2 s in their middle.
  template <class Broken>
  std::vector<Row> estimate(const Broken& broken) {
    std::string text = "time_s,current_A,voltage_V,position_mm,oil_temperature_C\n";
    for (int k = 0; k < samples; ++k) {
      const double swing = std::sin(0.004 * k), current_A = 1.2 + 0.5 * swing;
      const auto [shown_A, shown_V] = k >= from && k < to ? broken(current_A) : std::pair(current_A, 2.9 * current_A);
      text += fmt::format("{:.3f},{},{},{:.5f},50\n", 1e-3 * k, shown_A, shown_V, 1.1 + 0.9 * swing);
    }
    write("run.csv", text);
    const Answer answer = run("estimate -q " SPOOLFLOW_EXAMPLE_MODEL " run.csv -o flow.csv");
    EXPECT_EQ(answer.status, 0) << answer.message;
    std::istringstream lines(content("flow.csv"));
    std::string line;
    std::getline(lines, line);
    std::vector<Row> rows;
    while (std::getline(lines, line)) {
      Row row;
      char comma{};
      double time_s{};
      std::istringstream cells(line);
      cells >> time_s >> comma >> row.flow_L_min >> comma >> row.lower_L_min >> comma >> row.upper_L_min;
      row.status = line.substr(line.rfind(',') + 1);
      rows.push_back(row);
    }
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(samples));
    return rows;
  }
  static constexpr int samples = 2000, from = 1000, to = 1200;
};

TEST_F(EstimateFaults, ACurrentThatNoCoilCarriesHoldsTheFlowWithABandThatHoldsTheTruth) {
  const std::vector<Row> sound = estimate([](double current_A) { return std::pair(current_A, 2.9 * current_A); });
  for (const double broken_A : {4.0, 8.0, 20.0}) {
    const std::vector<Row> rows = estimate([&](double current_A) { return std::pair(broken_A, 2.9 * current_A); });
    int inside = 0;
    for (auto k = static_cast<std::size_t>(from); k < static_cast<std::size_t>(to); ++k) {
      ASSERT_THAT(rows[k].status, HasSubstr("sample_missing|coil_fault")) << broken_A << " A, sample " << k;
      inside += rows[k].lower_L_min <= sound[k].flow_L_min && sound[k].flow_L_min <= rows[k].upper_L_min ? 1 : 0;
    }
    EXPECT_GT(inside, 190) << broken_A;
    EXPECT_THAT(rows[to + 100].status, Not(HasSubstr("sample_missing")));
  }
}

TEST_F(EstimateFaults, ValuesThatAreMissingAreCountedByChannelWithWhatTheEstimateDoesThere) {
  std::string text = "time_s,current_A,voltage_V,position_mm,oil_temperature_C\n";
  for (int k = 0; k < 100; ++k)
    text += fmt::format("{:.3f},{},3,1.1,{}\n", 1e-3 * k, k == 50 ? "" : "1.2", k < 40 ? "" : "50");
  write("gaps.csv", text);
  const Answer answer = run("estimate " SPOOLFLOW_EXAMPLE_MODEL " gaps.csv -o flow.csv");
  EXPECT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.message, HasSubstr("1 values of current are missing; the estimate is held there"));
  EXPECT_THAT(answer.message, HasSubstr("40 values of oil_temperature are missing; the last one stands in there"));
}

TEST_F(EstimateFaults, AClockThatRunsTooFastIsReportedByTheInducedVoltage) {
  const auto said_with = [&](const std::string& scale) {
    write("map.toml", "[channels]\ntime = { column = \"time_s\", unit = \"s\", scale = " + scale + " }\n");
    return run("estimate -q " SPOOLFLOW_EXAMPLE_MODEL " " SPOOLFLOW_EXAMPLES
               "/valve_a/duty_cycle_1.h5 --channels map.toml -o /dev/null")
        .message;
  };
  EXPECT_THAT(said_with("0.6"), HasSubstr("duty_cycle_1.h5: time runs 1.6 times too fast"));
  EXPECT_THAT(said_with("1"), Not(HasSubstr("time runs")));
}

// Where the edge is closed nothing flows, and the forces must be those of the calibrated springs and coil.
TEST_F(EstimateFaults, ACurrentThatReadsFivePercentTooHighContradictsTheModel) {
  const auto said_by = [&](const std::string& command, const std::string& scale) {
    write("map.toml", "[channels]\ncurrent = { column = \"current_A\", unit = \"A\", scale = " + scale + " }\n");
    return run(command +
               " -q " SPOOLFLOW_EXAMPLE_MODEL " " SPOOLFLOW_EXAMPLES "/valve_a/ramp_60bar.h5 --channels map.toml " +
               (command == "estimate" ? "-o /dev/null" : "--json out.json"));
  };
  EXPECT_THAT(said_by("estimate", "1.05").message, HasSubstr("ramp_60bar.h5: the forces contradict the model"));
  EXPECT_THAT(said_by("estimate", "1.05").message, HasSubstr("a current that reads too high"));
  EXPECT_THAT(said_by("estimate", "0.95").message, HasSubstr("a current that reads too low"));
  EXPECT_THAT(said_by("estimate", "1").message, Not(HasSubstr("contradict")));
  EXPECT_EQ(said_by("validate", "1.05").status, 0);
  EXPECT_THAT(content("out.json"), HasSubstr("the forces contradict the model"));
}

// A duty cycle that never closes shows no force without flow: more of it may be another pressure.
TEST_F(EstimateFaults, ForcesThatMostlyAskForMorePressureThanCalibratedAreReportedUnlessItIsDeclared) {
  const auto said_with = [&](const std::string& scale, const std::string& options) {
    write("map.toml", "[channels]\ncurrent = { column = \"current_A\", unit = \"A\", scale = " + scale + " }\n");
    return run("estimate -q " SPOOLFLOW_EXAMPLE_MODEL " " SPOOLFLOW_EXAMPLES
               "/valve_a/duty_cycle_1.h5 --channels map.toml -o /dev/null" +
               options)
        .message;
  };
  write("machine.toml", "[environment]\nhighest_pressure_bar = 160\n");
  EXPECT_THAT(said_with("1.15", ""),
              HasSubstr("% of the time the forces ask for a higher pressure difference than is"));
  EXPECT_THAT(said_with("1.15", " --environment machine.toml"), Not(HasSubstr("% of the time the forces ask")));
  EXPECT_THAT(said_with("1", ""), Not(HasSubstr("% of the time the forces ask")));
}

TEST_F(EstimateFaults, BenchesWhoseLoadCellReadsTwoNewtonTooMuchContradictTheirOperatingRun) {
  std::filesystem::copy(SPOOLFLOW_EXAMPLES "/valve_a", folder / "valve_a");
  std::string campaign = content("valve_a/campaign.toml");
  const std::string map = "file = \"solenoid_map.h5\"";
  ASSERT_THAT(campaign, HasSubstr(map));
  campaign.replace(campaign.find(map), map.size(),
                   map + "\n[recording.channels]\nforce = { column = \"force_N\", unit = \"N\", offset = 2 }");
  write("valve_a/campaign.toml", campaign);
  const Answer answer = run("calibrate -q valve_a/campaign.toml -o model.json");
  EXPECT_EQ(answer.status, 0) << answer.message;
  EXPECT_THAT(answer.message, HasSubstr("ramp_60bar.h5: forces in operation contradict the benches; beside them the "
                                        "coil pulls as with"));
  EXPECT_THAT(content("model.json"), HasSubstr("contradict the benches"));
}

TEST_F(EstimateFaults, AVoltageOfSeveralSuppliesIsReported) {
  const std::vector<Row> sound = estimate([](double current_A) { return std::pair(current_A, 2.9 * current_A); });
  const std::vector<Row> rows = estimate([](double current_A) { return std::pair(current_A, 200.0); });
  for (auto k = static_cast<std::size_t>(from); k < static_cast<std::size_t>(to); ++k) {
    ASSERT_THAT(rows[k].status, HasSubstr("coil_fault")) << k;
    ASSERT_THAT(rows[k].status, Not(HasSubstr("sample_missing"))) << k;
    EXPECT_NEAR(rows[k].flow_L_min, sound[k].flow_L_min, 0.1) << k;
  }
}

}  // namespace
}  // namespace spoolflow::apps

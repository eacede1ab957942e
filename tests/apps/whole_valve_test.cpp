/// A whole valve on the command line, with the inputs that a newcomer mixes up: models of one direction and of both,
/// recordings of one coil and of two.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

/// The spool goes slowly from one side of the centre to the other.
class WholeValve : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    fs::copy_file(SPOOLFLOW_EXAMPLE_MODEL, folder / "one.json");
    nlohmann::json model = nlohmann::json::parse(content("one.json"));
    model["valve"]["direction"] = "a";
    write("one_a.json", model.dump());
    model["valve"]["direction"] = "both";
    for (const char* part : {"condensed", "observer", "evidence"}) model["p_to_a"][part] = model[part];
    write("whole.json", model.dump());
    write("both.csv", run_through_centre("current_a_A,current_b_A", [](double a_A, double b_A) {
            return fmt::format("{:.4f},{:.4f}", a_A, b_A);
          }));
    write("active.csv", run_through_centre("current_A", [](double a_A, double b_A) {
            return fmt::format("{:.4f}", std::max(a_A, b_A));
          }));
  }

  /// `currents(a, b)`: the cells under `head`.
  static std::string run_through_centre(const std::string& head,
                                        const std::function<std::string(double, double)>& currents) {
    std::string out = "time_s,position_mm," + head + ",flow_reference_L_min\n";
    constexpr int samples = 4000;
    for (int k = 0; k < samples; ++k) {
      const double position_mm = -1.0 + 2.0 * k / samples;
      const double current_A = 0.6 + 0.4 * std::abs(position_mm);
      out += fmt::format("{:.3f},{:.5f},{},{:.3f}\n", 1e-3 * k, position_mm,
                         currents(position_mm < 0 ? current_A : 0, position_mm < 0 ? 0 : current_A), 20 * position_mm);
    }
    return out;
  }

  void expect_refused(const std::string& arguments, const std::vector<std::string>& reasons) const {
    const Answer answer = run(arguments);
    EXPECT_EQ(answer.status, 2) << arguments;
    EXPECT_THAT(answer.output, IsEmpty()) << arguments;
    EXPECT_THAT(answer.message, StartsWith("spoolflow " + arguments.substr(0, arguments.find(' ')) + ": "));
    for (const std::string& reason : reasons) EXPECT_THAT(answer.message, HasSubstr(reason)) << arguments;
    EXPECT_EQ(std::count(answer.message.begin(), answer.message.end(), '\n'), 1) << answer.message;
  }
  [[nodiscard]] nlohmann::json json(const std::string& file) const { return nlohmann::json::parse(content(file)); }
};

TEST_F(WholeValve, AModelOfOneDirectionSaysOtherDirectionAndTheReportCountsTheFault) {
  const Answer estimated = run("estimate one.json both.csv -o estimate.csv");
  ASSERT_EQ(estimated.status, 0) << estimated.message;
  EXPECT_NE(content("estimate.csv").find("other_direction"), std::string::npos);
  const Answer validated = run("validate one.json both.csv --json metrics.json");
  ASSERT_EQ(validated.status, 0) << validated.message;
  EXPECT_THAT(validated.output, HasSubstr("other_direction for "));
  const nlohmann::json observer = json("metrics.json")["runs"][0]["estimators"][1];
  EXPECT_GT(observer["status_share"]["other_direction"], 0.4);
  EXPECT_LT(observer["status_share"]["other_direction"], 0.6);
  EXPECT_FALSE(observer.contains("sign"));
}

TEST_F(WholeValve, AModelOfPToARefusesARunThatCountsTheOtherWay) {
  expect_refused("estimate one_a.json both.csv -o estimate.csv",
                 {"both.csv", "channel current is missing", "scale -1"});
}

TEST_F(WholeValve, AModelOfBothDirectionsTakesTheActiveCoilsCurrentForTheOtherIsSilent) {
  ASSERT_EQ(run("estimate whole.json both.csv -o both_estimate.csv").status, 0);
  const Answer active = run("estimate whole.json active.csv -o active_estimate.csv");
  ASSERT_EQ(active.status, 0) << active.message;
  EXPECT_TRUE(content("active_estimate.csv") == content("both_estimate.csv"));
  EXPECT_EQ(content("both_estimate.csv").find("other_direction"), std::string::npos);
}

TEST_F(WholeValve, ReferencesSayTheirDirectionAndTheSpoolRestsInTheCentre) {
  write("stroke.toml",
        "[[reference]]\nkind = \"pump\"\nmarks = \"marks.csv\"\ndisplacement_cm3 = 20\nspeed_rpm = 1500\n");
  write("marks.csv", "begin_s,end_s\n2.5,3.5\n");
  expect_refused("recalibrate whole.json both.csv --references stroke.toml -o moved.json",
                 {"line 1: pump 1 does not say which direction"});
  write("meter.toml", "[[reference]]\nkind = \"meter\"\n");
  expect_refused("recalibrate whole.json both.csv --references meter.toml -o moved.json",
                 {"both.csv", "the spool rests in the centre without current"});
  expect_refused("recalibrate whole.json active.csv --references meter.toml -o moved.json", {"current_a is missing"});
}

TEST_F(WholeValve, OneCoilsCurrentBesideTheActiveOnesIsRefused) {
  write("two.csv", "time_s,position_mm,current_a_A,current_A\n0,0.1,0.5,0.5\n0.001,0.1,0.5,0.5\n");
  expect_refused("estimate whole.json two.csv -o estimate.csv",
                 {"two.csv: \"current_a\" stands beside \"current\", which is the active coil's"});
}

TEST_F(WholeValve, WithoutAnyCoilCurrentIsRefused) {
  write("none.csv", "time_s,position_mm,current_a_A\n0,0.1,0.5\n0.001,0.1,0.5\n");
  expect_refused("estimate whole.json none.csv -o estimate.csv", {"none.csv", "current_a", "current_b"});
}

TEST_F(WholeValve, IsJudgedOverSignedFlowAndOnBothSidesOfTheCentre) {
  const Answer answer = run("validate whole.json both.csv --json metrics.json --report page.html");
  ASSERT_EQ(answer.status, 0) << answer.message;
  const nlohmann::json observer = json("metrics.json")["all_runs"][1];
  const nlohmann::json over = observer["error_over"];
  EXPECT_LT(over["flow_L_min"].front()["from"], -15);
  EXPECT_LT(over["position_mm"].front()["from"], -0.8);
  EXPECT_GT(over["position_mm"].back()["to"], 0.8);
  EXPECT_GT(observer["error"]["p_to_a"]["samples"], 1000);
  EXPECT_GT(observer["error"]["p_to_b"]["samples"], 1000);
  EXPECT_EQ(observer["sign"]["wrong"], 0);
  const std::string page = content("page.html");
  for (const char* part :
       {">Flow P to B<", ">Flow P to A<", "coil current, b &gt; 0, a &lt; 0", "Coil current, b less a"}) {
    EXPECT_NE(page.find(part), std::string::npos) << part;
  }
}

TEST_F(WholeValve, NeedsBenchRecordingsOfBothDirectionsBesideItsRun) {
  const auto campaign = [](const std::string& direction) {
    return fmt::format(
        "[valve]\nname = \"v\"\nrated_flow_L_min = 80\nstroke_mm = 2.4\n[[recording]]\nprotocol = \"spring\"\n"
        "direction = \"{}\"\nfile = \"{}/valve_a/spring.h5\"\n[[recording]]\nprotocol = \"operation\"\n"
        "file = \"both.csv\"\n",
        direction, SPOOLFLOW_EXAMPLES);
  };
  write("one.toml", campaign("b"));
  expect_refused("calibrate one.toml --allow-outside -o model.json", {"one.toml", "both.csv", "both directions"});
  write("c.toml", campaign("c"));
  expect_refused("calibrate c.toml --allow-outside -o model.json",
                 {"c.toml, line 7", "\"c\"", "\"b\" (flow P to B), \"a\" (P to A)"});
}

TEST_F(WholeValve, IsAnalysedInOneDirectionAndThePageSaysWhich) {
  write("s.toml",
        "[points]\npositions_percent = [50]\npressure_differences_bar = [40]\n[monte_carlo]\ntrials = 100\n[map]\n"
        "positions = 3\npressure_differences = 2\n[study]\nskip = true\n");
  const Answer of_b = run("analyse whole.json --scenario s.toml --report b.html --json b.json");
  ASSERT_EQ(of_b.status, 0) << of_b.message;
  EXPECT_NE(content("b.html").find(", flow P to B"), std::string::npos);
  ASSERT_EQ(run("analyse whole.json --direction a --scenario s.toml --report a.html").status, 0);
  EXPECT_NE(content("a.html").find(", flow P to A"), std::string::npos);
  EXPECT_EQ(json("b.json")["direction"], "b");
  expect_refused("analyse one.json --direction a --json o.json", {"one.json", "--direction a"});
  expect_refused("analyse whole.json --direction c --json o.json", {"--direction"});
  for (const char* direction : {"a", "b"}) {
    expect_refused(fmt::format("analyse whole.json --direction {} --recording both.csv --json o.json", direction),
                   {"both.csv", "whole valve", "one direction"});
  }
}

}  // namespace
}  // namespace spoolflow::apps

#include "addons/playground/requests/playground.hpp"

#include <filesystem>
#include <fstream>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/recording/temporary_file.hpp"

namespace spoolflow::playground {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string example_model = SPOOLFLOW_EXAMPLES "/live/size_6.json";

json answered(Playground& playground, const json& request) {
  return json::parse(playground.answer(request.dump()));
}

Playground silent() {
  return Playground({.progress = [](double, std::string_view) {},
                     .opened = [](const std::string& file) { return std::make_unique<std::ofstream>(file); }});
}

TEST(Playground, ReportsFaultsInTheProgramsOwnWords) {
  Playground playground = silent();
  const json missing = answered(playground, {{"work", "inspect"}, {"file", "/nowhere/run.csv"}});
  EXPECT_THAT(missing.at("error").get<std::string>(), HasSubstr("/nowhere/run.csv"));
  EXPECT_THAT(answered(playground, {{"work", "dance"}}).at("error").get<std::string>(), HasSubstr("dance"));
  EXPECT_THAT(json::parse(playground.answer("no JSON")).at("error").get<std::string>(), HasSubstr("parse"));
  EXPECT_THAT(answered(playground, {{"work", "play"}, {"duration_s", 0.1}}).at("error").get<std::string>(),
              HasSubstr("play_begin"));
}

/// Mean of a column over its second half, when the valve has settled.
double settled(const json& samples, const char* column) {
  const auto values = samples.at(column).get<std::vector<double>>();
  const auto half = static_cast<std::ptrdiff_t>(values.size() / 2);
  return std::accumulate(values.begin() + half, values.end(), 0.0) / static_cast<double>(values.size() - half);
}

TEST(Playground, AValveThatIsOpenedFurtherPassesMoreOilAndTheSensorFollows) {
  Playground playground = silent();
  ASSERT_EQ(answered(playground, {{"work", "play_begin"}, {"model", example_model}}), json::object());
  double before_L_min = -1;
  for (const double command : {40, 60, 90}) {
    const json samples = answered(
        playground, {{"work", "play"}, {"duration_s", 0.6}, {"command_percent", command}, {"pressure_bar", 60}});
    ASSERT_FALSE(samples.contains("error")) << samples;
    const double true_L_min = settled(samples, "true_flow_L_min");
    EXPECT_GT(true_L_min, before_L_min + 5);
    EXPECT_NEAR(settled(samples, "flow_L_min"), true_L_min, 8);
    before_L_min = true_L_min;
  }
}

TEST(Playground, FilesGoThroughInspectionEstimateAndValidation) {
  const recording::TemporaryFile scenario("scenario.toml",
                                          "protocol = \"steps\"\nvalve = \"size_6\"\n[run]\nhold_s = 0.1\n");
  const auto in = [&](const char* name) { return (scenario.folder() / name).string(); };
  Playground playground = silent();
  const json made = answered(playground, {{"work", "simulate"},
                                          {"scenario", in("scenario.toml")},
                                          {"recording", in("run.csv")},
                                          {"truth", in("truth.csv")}});
  ASSERT_FALSE(made.contains("error")) << made;
  const json inspected = answered(playground, {{"work", "inspect"}, {"file", in("run.csv")}});
  EXPECT_EQ(inspected.at("inspection").at("samples"), made.at("samples"));
  const json estimated = answered(
      playground,
      {{"work", "estimate"}, {"model", example_model}, {"recording", in("run.csv")}, {"output", in("estimate.csv")}});
  EXPECT_THAT(estimated.at("sentence").get<std::string>(), HasSubstr("samples"));
  const json judged = answered(playground, {{"work", "validate"},
                                            {"model", example_model},
                                            {"recordings", {in("run.csv")}},
                                            {"report", in("report.html")},
                                            {"metrics", in("metrics.json")}});
  EXPECT_FALSE(judged.at("sentence").get<std::string>().empty());
  EXPECT_GT(std::filesystem::file_size(in("report.html")), 50'000U);
}

}  // namespace
}  // namespace spoolflow::playground

/// `validate` against the independent scoring script that is kept beside the project, where it is at hand.
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/apps/command_line.hpp"

namespace spoolflow::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Folder of the reference recordings and tools; SPOOLFLOW_SHARED names another.
fs::path shared() {
  const char* named = std::getenv("SPOOLFLOW_SHARED");
  return named != nullptr ? fs::path(named) : fs::path(SPOOLFLOW_EXAMPLES "/../../shared");
}

using Score = CommandLine;

TEST_F(Score, OfTheScriptAndFiguresOfTheReportAgreeToRounding) {
  const fs::path script = shared() / "tools/score.py";
  const fs::path recording = shared() / "recordings/valve_a/ramp_60bar.csv";
  if (!fs::exists(script) || !fs::exists(recording)) GTEST_SKIP() << "no " << script;
  ASSERT_EQ(run("calibrate -q " SPOOLFLOW_EXAMPLES "/valve_a/campaign.toml -o model.json").status, 0);
  ASSERT_EQ(run("estimate -q model.json '" + recording.string() + "' -o estimate.csv --estimator condensed").status, 0);
  // The script compares with what the meter shows at the time.
  const std::string validate =
      "validate -q model.json '" + recording.string() + "' --json metrics.json --no-reference-lag";
  ASSERT_EQ(run(validate + " --estimator condensed").status, 0);
  const std::string score = "cd '" + folder.string() + "' && python3 '" + script.string() + "' '" + recording.string() +
                            "' estimate.csv --json > score.json";
  ASSERT_EQ(std::system(score.c_str()), 0);
  const json theirs = json::parse(content("score.json"));
  const json ours = json::parse(content("metrics.json")).at("runs").at(0).at("estimators").at(0).at("error");
  // Metrics keep errors as float: 1e-5 % FS; the six decimals of the file are less.
  constexpr double rounding_percent_FS = 2e-5;
  // The script takes motion from the command, the report by the spool: over all samples they must agree.
  for (const char* phase : {"all"}) {
    EXPECT_EQ(ours.at(phase).at("samples").get<double>(), theirs.at(phase).at("samples").get<double>()) << phase;
    for (const auto& [mine, other] : {std::pair{"p95", "p95"}, {"rms", "rms"}, {"largest", "max"}, {"bias", "bias"}}) {
      EXPECT_NEAR(ours.at(phase).at(mine).at("percent_FS").get<double>(), theirs.at(phase).at(other).get<double>(),
                  rounding_percent_FS)
          << phase << ' ' << mine;
    }
  }
  EXPECT_NEAR(ours.at("all").at("band_coverage").get<double>(), theirs.at("band_95_coverage").get<double>(), 2e-3);
  EXPECT_NEAR(ours.at("all").at("band_mean_width").at("percent_FS").get<double>(),
              theirs.at("band_mean_width").get<double>(), rounding_percent_FS);
}

}  // namespace
}  // namespace spoolflow::apps

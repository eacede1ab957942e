/// Ends of strokes that nothing but the valve's forces shows.
#include <gtest/gtest.h>

#include "spoolflow/calibration/references/passed_oil.hpp"
#include "spoolflow/recording/reader.hpp"
#include "tests/calibration/type/virtual_unit.hpp"
#include "tests/recording/temporary_file.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;

constexpr double stroke_s = 2 * (3 + 0.2), first_s = 0.5;  // of write_strokes

/// Four strokes of 3 s out and 3 s back; the piston stands after so long, or is never there.
std::vector<recording::TimeMark> seen(double stalls_after_s) {
  const model::Model model = model::read_model(SPOOLFLOW_EXAMPLE_MODEL);
  sensor::ObserverParameters<double> valve = model.observer->parameters;
  valve.position_sensor.drift_m_per_K = 0;
  const recording::TemporaryFile file("stalled.csv");
  write_strokes(file.path(), valve, {45, 30, 60, 45}, model.valve.stroke_m, 3, stalls_after_s);
  recording::ReadOptions options;
  options.required = {Channel::time, Channel::current, Channel::position};
  options.optional = {Channel::oil_temperature};
  return stalled_strokes(valve, model.valve.rated_flow_m3_per_s, recording::read_recording(file.path(), options));
}

TEST(StalledStrokes, EndWhereTheForcesLoseTheFlowAndTheFirstIsLeftOut) {
  const double stalls_after_s = 2.4;
  const std::vector<recording::TimeMark> marks = seen(stalls_after_s);
  ASSERT_EQ(marks.size(), 3U);
  for (std::size_t k = 0; k < marks.size(); ++k) {
    const double begin_s = first_s + static_cast<double>(k + 1) * stroke_s;
    EXPECT_GE(marks[k].begin_s, begin_s - 0.2);  // closed
    EXPECT_LE(marks[k].begin_s, begin_s + 0.4);  // the overlap passed
    EXPECT_GE(marks[k].end_s, begin_s + stalls_after_s - 0.01);
    EXPECT_LE(marks[k].end_s, begin_s + stalls_after_s + 0.05);
  }
}

TEST(StalledStrokes, AreNoneWhereThePistonComesToNoEnd) {
  EXPECT_TRUE(seen(1e9).empty());
}

}  // namespace
}  // namespace spoolflow::calibration

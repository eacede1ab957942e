#include "spoolflow/calibration/edges_in_operation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/calibration/closed_form_edges.hpp"

namespace spoolflow::calibration {
namespace {

using recording::Channel;

const model::Valve valve_at_work{"closed form", 60 / 60000.0, bench_stroke_m, "b"};

/// The path at work behind a cylinder, 50 bar over it, the spool to and fro on the side of that sign.
recording::Recording at_work(const ClosedFormEdge& inlet, const ClosedFormEdge& outlet, double k, double sign,
                             double to_m = bench_stroke_m) {
  const Drive motion = drive({{.to_m = to_m}}, 0);
  recording::Recording out;
  out.file = "work.csv";
  out.column(Channel::time) = motion.time_s;
  for (const double x_m : motion.position_m) {
    out.column(Channel::position).push_back(sign * x_m);
    out.column(Channel::pressure_difference).push_back(50e5);
    out.column(Channel::flow_reference).push_back(sign * reading_of(inlet, outlet, k, x_m, 50e5).flow_m3_per_s);
  }
  return out;
}

std::optional<EdgeRatio> ratio_found_in(const recording::Recording& run, const ClosedFormEdge& inlet,
                                        const ClosedFormEdge& outlet, double k, double sign) {
  const recording::Recording spring = axial_force_recording({{}}, 0);
  const recording::Recording both =
      recorded("joined.csv", [&](double x_m, double p_Pa) { return reading_of(inlet, outlet, 1, x_m, p_Pa); });
  CampaignRecordings benches{spring, spring, {}, {}, {}};
  benches.axial_force_maps.joined = {&both};
  benches.axial_force_maps.outlet_flow_ratio = k;
  return edge_ratio_in_operation(benches, {{{&run}, sign}}, valve_at_work);
}

TEST(EdgesInOperation, AreSeparatedByTheFlowThatTheCylinderMakesOfAPressureDifference) {
  const double ratio = narrow.conductance_per_m / wide.conductance_per_m;
  for (const double sign : {1.0, -1.0}) {
    const auto found = ratio_found_in(at_work(wide, narrow, 0.6, sign), wide, narrow, 0.6, sign);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->value, ratio, 0.01);
    EXPECT_LT(found->lowest, ratio);
    EXPECT_GT(found->highest, ratio);
    EXPECT_LT(found->highest - found->lowest, 0.3 * ratio);  // the meter's percent, and no more
  }
  const auto other_way = ratio_found_in(at_work(narrow, wide, 1 / 0.6, 1), narrow, wide, 1 / 0.6, 1);
  ASSERT_TRUE(other_way);
  EXPECT_NEAR(other_way->value, 1 / ratio, 0.05);
}

TEST(EdgesInOperation, AreNotFoundInARunThatHardlyOpensOrShowsNoPressureOrAnotherLoad) {
  EXPECT_FALSE(ratio_found_in(at_work(wide, narrow, 0.6, 1, 0.9e-3), wide, narrow, 0.6, 1));
  EXPECT_FALSE(ratio_found_in(at_work(wide, narrow, 0.6, 1), wide, narrow, 0.6, -1));  // the other side of the centre
  EXPECT_FALSE(ratio_found_in(at_work(wide, narrow, 3.0, 1), wide, narrow, 0.6, 1));
  recording::Recording blind = at_work(wide, narrow, 0.6, 1);
  recording::Recording without;
  without.file = blind.file;
  for (const Channel channel : {Channel::time, Channel::position, Channel::flow_reference})
    without.column(channel) = blind.column(channel);
  EXPECT_FALSE(ratio_found_in(without, wide, narrow, 0.6, 1));
}

}  // namespace
}  // namespace spoolflow::calibration

/// A run that cannot be of its valve is named; a sound one, however short, raises nothing.
#include "spoolflow/plausibility/run_findings.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "spoolflow/numerics/meter_lag.hpp"
#include "spoolflow/plausibility/limits.hpp"
#include "tests/plausibility/example_campaign.hpp"
#include "tests/plausibility/finding_texts.hpp"
#include "tests/plausibility/rig_benches.hpp"

namespace spoolflow::plausibility {
namespace {

using recording::Channel;

const RigBenches& sound_size_6() {
  static const RigBenches valve = rig_benches("size_6", 0);
  return valve;
}

/// The rows of some seconds of a run.
recording::Recording clip(const recording::Recording& run, std::size_t begin, std::size_t rows) {
  recording::Recording out{run.file, {}};
  for (const Channel channel : recording::all_channels) {
    if (!run.has(channel)) continue;
    const auto from = run.column(channel).begin() + static_cast<std::ptrdiff_t>(begin);
    out.column(channel).assign(from, from + static_cast<std::ptrdiff_t>(rows));
  }
  return out;
}

void keep_what_a_sensor_reads(recording::Recording& run) {
  for (const Channel other : {Channel::pressure_upstream, Channel::pressure_downstream, Channel::flow_reference})
    run.column(other).clear();
}

/// A dither of 100 Hz, and the voltage that it takes: some of its samples catch the current at its peaks, where it
/// stands still for a moment while the voltage is far from what the resistance alone takes.
void lay_dither_on(recording::Recording& run) {
  constexpr double swing_A = 0.15, swing_V = 6, pi = 3.14159265358979;
  for (std::size_t k = 0; k < run.size(); ++k) {
    const double phase = 2 * pi * 100 * run.column(Channel::time)[k];
    run.column(Channel::current)[k] += swing_A * std::sin(phase);
    run.column(Channel::voltage)[k] += swing_V * std::sin(phase + 1.2);
  }
}

TEST(RunFindings, AreNoneOfAFewSecondsOfASoundRunWhetherItIsDitheredOrHardlyOpens) {
  const RigBenches& valve = sound_size_6();
  const std::vector<KnownValve> known{known_valve(valve.benches())};
  recording::Recording run = valve.recordings.at("ramp_60bar.csv");
  const std::size_t second = 1000;
  ASSERT_GT(run.size(), 10 * second);
  keep_what_a_sensor_reads(run);
  for (const bool dithered : {false, true}) {
    if (dithered) lay_dither_on(run);
    for (std::size_t begin = 0; begin + 3 * second <= run.size(); begin += second / 2) {
      for (const std::size_t rows : {2 * second, 3 * second}) {
        EXPECT_THAT(all_texts(run_findings(known, means_of(clip(run, begin, rows)), "clip.csv")), testing::IsEmpty())
            << "from " << begin << (dithered ? " with dither" : "");
      }
    }
  }
}

TEST(RunFindings, AreNoneOfAMetersNoiseBesideAValveThatHardlyLetsOilThrough) {
  const RigBenches& valve = sound_size_6();
  const std::vector<KnownValve> known{known_valve(valve.benches())};
  const recording::Recording& run = valve.recordings.at("ramp_60bar.csv");
  const std::vector<double>& flow = run.column(Channel::flow_reference);
  const double little = 0.05 * std::ranges::max(flow);
  std::size_t rows = 0;
  while (flow[rows] < little) ++rows;
  ASSERT_GT(run.column(Channel::time)[rows], 3);
  recording::Recording beginning = clip(run, 0, rows);
  const double noise = 0.1 * little;
  for (std::size_t k = 0; k < rows; ++k) beginning.column(Channel::flow_reference)[k] += k % 2 == 0 ? noise : -noise;
  EXPECT_THAT(all_texts(run_findings(known, means_of(beginning), "closed.csv")), testing::IsEmpty());
}

TEST(RunFindings, AreNoneOfAFewSecondsOfFastMotionBesideASlowMeter) {
  const RigBenches& valve = sound_size_6();
  const std::vector<KnownValve> known{known_valve(valve.benches())};
  recording::Recording run = valve.recordings.at("ramp_60bar.csv");
  constexpr double faster = 15;
  for (double& time_s : run.column(Channel::time)) time_s /= faster;
  std::vector<double>& reference = run.column(Channel::flow_reference);
  const std::vector<double> prompt = reference;
  const auto rows = static_cast<std::size_t>(2.7 / (run.column(Channel::time)[1] - run.column(Channel::time)[0]));
  ASSERT_GT(run.size(), rows);
  for (const double lag_s : {0.03, 0.1, 0.3}) {
    reference = prompt;
    numerics::apply_lag<double>(run.column(Channel::time), reference, {.dead_time_s = 0.01, .lag_s = lag_s});
    for (std::size_t begin = 0; begin + rows <= run.size(); begin += rows / 8) {
      recording::Recording part = clip(run, begin, rows);
      EXPECT_THAT(all_texts(run_findings(known, means_of(part), "clip.csv")), testing::IsEmpty())
          << "from " << begin << " with a lag of " << lag_s << " s";
      for (double& flow : part.column(Channel::flow_reference)) flow *= 2;
      EXPECT_THAT(all_texts(run_findings(known, means_of(part), "clip.csv")), testing::HasSubstr("looks doubled"))
          << "from " << begin << " with a lag of " << lag_s << " s";
    }
  }
}

TEST(RunFindings, AreNoneOfACableOfThePositionSensorThatIsTornFromSomeSampleOn) {
  const RigBenches& valve = sound_size_6();
  const std::vector<KnownValve> known{known_valve(valve.benches())};
  for (const std::size_t torn_from : {0U, 400U, 2990U}) {
    recording::Recording run = clip(valve.recordings.at("ramp_60bar.csv"), 0, 3000);
    keep_what_a_sensor_reads(run);
    for (std::size_t k = torn_from; k < run.size(); ++k) run.column(Channel::position)[k] = std::nan("");
    EXPECT_THAT(all_texts(run_findings(known, means_of(run), "torn.csv")), testing::IsEmpty()) << torn_from;
  }
}

/// Of a valve whose position was recorded as finely on the bench as in this run.
std::vector<KnownValve> as_fine_as(const recording::Recording& run) {
  std::vector<KnownValve> known{known_valve(sound_size_6().benches())};
  known.front().position_noise_m = means_of(run).position_resolution().noise_m();
  return known;
}

TEST(RunFindings, NameThePressureThatForcesAskForAndNothingWhereItIsDeclared) {
  const RigBenches& valve = sound_size_6();
  KnownValve known = known_valve(valve.benches());
  recording::Recording run = valve.recordings.at("ramp_60bar.csv");
  keep_what_a_sensor_reads(run);
  for (const Channel reference : {Channel::flow, Channel::pressure_difference}) run.column(reference).clear();
  known.hydraulics.highest_pressure_Pa = 20e5;
  const std::string found = all_texts(run_findings({known}, means_of(run), "run.csv"));
  EXPECT_THAT(found,
              testing::StartsWith("run.csv: forces ask for pressure differences of 30 bar at least, and 20 bar "));
  known.hydraulics.bounding_pressure_Pa = 60e5;
  EXPECT_EQ(all_texts(run_findings({known}, means_of(run), "run.csv")), "");
}

TEST(RunFindings, NameTwoColumnsInEachOthersPlaceEachReadInTheOthersUnit) {
  const RigBenches& valve = sound_size_6();
  const std::vector<KnownValve> known{known_valve(valve.benches())};
  const recording::Recording& sound = valve.recordings.at("ramp_60bar.csv");
  const auto text = [&](Channel one, Channel other, double one_per_other) {
    recording::Recording run = sound;
    std::swap(run.column(one), run.column(other));
    for (double& value : run.column(one)) value *= one_per_other;
    for (double& value : run.column(other)) value /= one_per_other;
    return all_texts(run_findings(known, means_of(run), "run.csv"));
  };
  EXPECT_THAT(text(Channel::position, Channel::current, 1e-3), testing::HasSubstr("position and current look swapped"));
  EXPECT_THAT(text(Channel::flow_reference, Channel::pressure_difference, 1 / 60e3 / 1e5),
              testing::HasSubstr("flow_reference and pressure_difference look swapped"));
}

TEST(RunFindings, BlameNothingElseOnColumnsInEachOthersPlace) {
  const recording::Recording& sound = example().recordings.at("ramp_60bar.h5");
  recording::Recording run = sound;
  std::swap(run.column(Channel::current), run.column(Channel::voltage));
  const std::string found = all_texts(run_findings({known_valve(example().benches())}, means_of(run), "run.h5"));
  EXPECT_THAT(found, testing::HasSubstr("current and voltage look swapped"));
  EXPECT_THAT(found, testing::Not(testing::HasSubstr("beats")));
}

TEST(RunFindings, NameOilInAnotherUnitAndNoneOfOilThatIsOnlyColdOrHot) {
  const RigBenches& valve = sound_size_6();
  std::vector<KnownValve> known{known_valve(valve.benches())};
  known.front().oil_temperature_K = {303.15, 333.15};
  const auto of_oil_at = [&](double read_K) {
    recording::Recording run = clip(valve.recordings.at("ramp_60bar.csv"), 0, 5000);
    keep_what_a_sensor_reads(run);
    run.column(Channel::oil_temperature).assign(run.size(), read_K);
    return all_texts(run_findings(known, means_of(run), "run.csv"));
  };
  const double zero_degC_K = 273.15;
  const double true_degC = 45;
  const double in_degF = true_degC * 9 / 5 + 32;
  EXPECT_THAT(of_oil_at(zero_degC_K + in_degF),
              testing::HasSubstr("oil_temperature looks in degF, not degC: so read it is 45 degC "
                                 "and not 113; the model's valve was calibrated at 30 to 60"));
  EXPECT_THAT(of_oil_at(2 * zero_degC_K + true_degC), testing::HasSubstr("looks in K, not degC"));
  EXPECT_THAT(of_oil_at(true_degC), testing::HasSubstr("looks in degC where K was said"));
  for (const double sound_degC : {-25.0, 0.0, 45.0, 79.0, 220.0})
    EXPECT_THAT(of_oil_at(zero_degC_K + sound_degC), testing::IsEmpty()) << sound_degC;
}

TEST(RunFindings, NameAVoltageThatStandsStillWhileTheCurrentChangesAndNoneOfAnIdleValve) {
  const RigBenches& valve = sound_size_6();
  const std::vector<KnownValve> known{known_valve(valve.benches())};
  recording::Recording run = valve.recordings.at("ramp_60bar.csv");
  std::ranges::fill(run.column(Channel::voltage), 24.0);
  EXPECT_THAT(all_texts(run_findings(known, means_of(run), "run.csv")),
              testing::HasSubstr("voltage stands still at 24"));
  recording::Recording idle = clip(run, 0, 500);
  std::ranges::fill(run.column(Channel::position), 1.2e-3);
  EXPECT_THAT(all_texts(run_findings(known, means_of(run), "run.csv")),
              testing::HasSubstr("position stands still at 1.2 mm"));
  std::ranges::fill(idle.column(Channel::voltage), 0.0);
  std::ranges::fill(idle.column(Channel::flow_reference), 0.0);
  EXPECT_THAT(all_texts(run_findings(known, means_of(idle), "idle.csv")),
              testing::Not(testing::HasSubstr("stands still")));
}

TEST(RunFindings, NameAPositionThatIsRecordedMoreCoarselyThanOnTheBench) {
  const recording::Recording run = sound_size_6().recordings.at("ramp_60bar.csv");
  const std::vector<KnownValve> known = as_fine_as(run);
  const double noise_m = known.front().position_noise_m;
  EXPECT_THAT(all_texts(run_findings(known, means_of(run), "fine.csv")), testing::IsEmpty());

  recording::Recording noisy = run;
  std::mt19937 random(7);
  std::normal_distribution<double> more(0, 3 * noise_m);
  for (double& position_m : noisy.column(Channel::position)) position_m += more(random);
  EXPECT_THAT(all_texts(run_findings(known, means_of(noisy), "noisy.csv")),
              testing::HasSubstr("noisy.csv: position comes with noise of"));

  recording::Recording tenfold = run;
  for (double& position_m : tenfold.column(Channel::position)) position_m *= 10;
  EXPECT_THAT(all_texts(run_findings(known, means_of(tenfold), "tenfold.csv")),
              testing::AllOf(testing::HasSubstr("position looks"), testing::Not(testing::HasSubstr("noise"))));

  recording::Recording rounded = run;
  for (double& position_m : rounded.column(Channel::position)) position_m = 1e-5 * std::round(position_m / 1e-5);
  EXPECT_THAT(all_texts(run_findings(known, means_of(rounded), "rounded.csv")),
              testing::HasSubstr("rounded.csv: position comes in steps of 10 um"));
}

TEST(RunFindings, NameAChannelThatIsFrozenForHalfARun) {
  const RigBenches& valve = sound_size_6();
  const std::vector<KnownValve> known{known_valve(valve.benches())};
  for (const Channel channel :
       {Channel::position, Channel::current, Channel::voltage, Channel::flow_reference, Channel::pressure_difference}) {
    for (const double from : {0.0, 0.25, 0.5}) {
      recording::Recording run = valve.recordings.at("ramp_60bar.csv");
      freeze_half(run.column(channel), from);
      EXPECT_THAT(all_texts(run_findings(known, means_of(run), "run.csv")),
                  testing::HasSubstr(fmt::format("run.csv: {} is frozen at", recording::name(channel))))
          << "from " << from << " of the run";
    }
  }
}

TEST(RunFindings, AreNoneOfASpoolThatRestsAtItsStopWhereItsPositionIsRecordedCoarsely) {
  const RigBenches& valve = sound_size_6();
  const std::vector<KnownValve> known{known_valve(valve.benches())};
  recording::Recording run = valve.recordings.at("ramp_60bar.csv");
  for (double& position_m : run.column(Channel::position)) position_m = 5e-5 * std::round(position_m / 5e-5);
  // The first second, in which the spool rests and the current rises, takes half of the run.
  std::size_t opens = 0;
  while (run.column(Channel::position)[opens] == 0) ++opens;
  const recording::Recording beginning = clip(run, 0, 2 * opens);
  EXPECT_THAT(all_texts(run_findings(known, means_of(beginning), "run.csv")),
              testing::Not(testing::HasSubstr("is frozen")));
}

TEST(RunFindings, NameAnOilTemperatureThatNeverChangesButNotOneOfWholeDegreesInAShortRun) {
  const RigBenches& valve = sound_size_6();
  const std::vector<KnownValve> known{known_valve(valve.benches())};
  const auto said = [&](double temperature_K) {
    recording::Recording run = valve.recordings.at("ramp_60bar.csv");
    run.column(Channel::oil_temperature).assign(run.size(), temperature_K);
    return all_texts(run_findings(known, means_of(run), "run.csv"));
  };
  const std::vector<double>& time_s = valve.recordings.at("ramp_60bar.csv").column(Channel::time);
  ASSERT_GT(time_s.back(), shortest_frozen_oil_s);
  ASSERT_LT(time_s.back(), shortest_round_oil_s);
  EXPECT_THAT(said(323.03), testing::HasSubstr("run.csv: oil_temperature is 49.88 degC to the last digit"));
  EXPECT_THAT(said(323.15), testing::IsEmpty());
}

TEST(RunFindings, NameOneSignedCurrentInTheColumnsOfBothCoils) {
  const RigBenches& valve = sound_size_6();
  const std::vector<KnownValve> known{known_valve(valve.benches()), known_valve(valve.benches())};
  recording::Recording run = valve.recordings.at("ramp_60bar.csv");
  run.column(Channel::current_a) = run.column(Channel::current_b) = run.column(Channel::current);
  EXPECT_THAT(all_texts(run_findings(known, means_of(run), "run.csv")),
              testing::HasSubstr("run.csv: current_a and current_b go together"));
}

TEST(RunFindings, JudgeEachSideOfAWholeValveByTheActiveCoilsCurrentWhereThatAloneIsThere) {
  const RigBenches& valve = sound_size_6();
  const std::vector<KnownValve> whole{known_valve(valve.benches()), known_valve(valve.benches())};
  recording::Recording run = both_sides(valve.recordings.at("ramp_60bar.csv"));
  for (std::size_t k = 0; k < run.size(); ++k) {
    const bool opens_a = run.column(Channel::position)[k] < 0;
    run.column(Channel::current).push_back(run.column(opens_a ? Channel::current_a : Channel::current_b)[k]);
  }
  run.column(Channel::current_a).clear();
  run.column(Channel::current_b).clear();
  EXPECT_THAT(all_texts(run_findings(whole, means_of(run), "run.csv")), testing::IsEmpty());
  const std::vector<KnownValve> p_to_b{whole.front()};
  EXPECT_THAT(all_texts(run_findings(p_to_b, means_of(run), "run.csv")), testing::IsEmpty());
  for (double& current_A : run.column(Channel::current)) current_A *= 2;
  EXPECT_THAT(all_texts(run_findings(whole, means_of(run), "run.csv")), testing::HasSubstr("current"));
}

TEST(RunFindings, NameAReferenceThatIsTwoSecondsLateOrEarlyAndNoneOfOneThatIsAsLateAsAMeter) {
  const RigBenches& valve = sound_size_6();
  const std::vector<KnownValve> one{known_valve(valve.benches())}, whole{one.front(), one.front()};
  const recording::Recording& ramp = valve.recordings.at("ramp_60bar.csv");
  const auto said = [&](const std::vector<KnownValve>& known, const recording::Recording& sound, double late_s) {
    recording::Recording run = sound;
    shift_by(run, late_s);
    return all_texts(run_findings(known, means_of(run), "run.csv"));
  };
  for (const bool both : {false, true}) {
    const std::vector<KnownValve>& known = both ? whole : one;
    const recording::Recording sound = both ? both_sides(ramp) : ramp;
    EXPECT_THAT(said(known, sound, 0), testing::IsEmpty());
    EXPECT_THAT(said(known, sound, 0.4), testing::Not(testing::HasSubstr("flow_reference comes")));
    EXPECT_THAT(said(known, sound, 2), testing::MatchesRegex("run.csv: flow_reference comes (2.0.|1.9.) s late.*"));
    EXPECT_THAT(said(known, sound, -2), testing::MatchesRegex("run.csv: flow_reference comes (2.0.|1.9.) s early.*"));
  }
}

TEST(RunFindings, NameAThermometerThatStartsLate) {
  const std::vector<KnownValve> known{known_valve(sound_size_6().benches())};
  recording::Recording run = sound_size_6().recordings.at("ramp_60bar.csv");
  std::vector<double>& oil_K = run.column(Channel::oil_temperature);
  oil_K.resize(run.size(), 323.15);
  std::mt19937 random(4);
  std::normal_distribution<double> noise(0, 0.05);
  for (double& value_K : oil_K) value_K += noise(random);
  EXPECT_THAT(all_texts(run_findings(known, means_of(run), "run.csv")), testing::Not(testing::HasSubstr("leaps")));
  for (const double first_K : {273.15, 293.15}) {
    std::fill_n(oil_K.begin(), 5000, first_K);
    EXPECT_THAT(
        all_texts(run_findings(known, means_of(run), "run.csv")),
        testing::HasSubstr(fmt::format("oil_temperature leaps from {:.1f} to 50.0 degC at 5.0 s", first_K - 273.15)));
  }
}

}  // namespace
}  // namespace spoolflow::plausibility

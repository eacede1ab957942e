/// Sensors stepped together against the same sensors by themselves: every answer and every byte that they remember.
#include "spoolflow/estimation/running_group.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/numerics/padding.hpp"
#include "tests/estimation/random_valve.hpp"

namespace spoolflow::estimation {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Which number of the states differs first, in their order; empty where none does. Equal states have equal bytes.
std::string difference(RunningState one, RunningState other) {
  numerics::clear_padding(one);
  numerics::clear_padding(other);
  if (std::memcmp(&one, &other, sizeof one) == 0) return "";
  std::string out;
  std::size_t number = 0;
  numerics::for_each_number(one, [&](const auto& value) {
    const auto offset = reinterpret_cast<const char*>(&value) - reinterpret_cast<const char*>(&one);
    auto there = value;
    std::memcpy(&there, reinterpret_cast<const char*>(&other) + offset, sizeof there);
    ++number;
    if (!out.empty() || std::memcmp(&value, &there, sizeof there) == 0) return;
    out = "number " + std::to_string(number) + ": " + std::to_string(static_cast<double>(value)) + ", alone " +
          std::to_string(static_cast<double>(there));
  });
  return out;
}
bool same_bytes(const sensor::Estimate<double>& one, const sensor::Estimate<double>& other) {
  return std::memcmp(&one, &other, offsetof(sensor::Estimate<double>, status)) == 0 && one.status == other.status;
}

/// One valve's sensor twice, with the samples that come to it.
struct Twins {
  RunningSensor grouped, alone;
  std::function<TimedSample()> next;
  std::vector<TimedSample> samples{};
  std::vector<sensor::Estimate<double>> answers{};
};

/// What was met on the way.
struct Met {
  std::uint32_t status = 0;
  std::size_t apart = 0, sliding = 0;
};

/// Round after round some of the valves get some samples, as many as chance has it, in blocks that differ in length.
Met run(std::vector<Twins>& valves, int rounds, GroupRegisters registers, unsigned seed) {
  RunningGroup group(registers);
  Dice dice(seed);
  Met met;
  for (int round = 0; round < rounds; ++round) {
    const std::uint64_t who = round % 4 == 0 ? ~std::uint64_t{0} : dice.bits();  // now all of them, now some
    const bool alike = dice.one_in(2);
    const auto length = [&] { return static_cast<std::size_t>(dice.bits() % 80); };
    const std::size_t common = length();
    std::vector<GroupedRun> runs;
    std::vector<Twins*> with;
    for (std::size_t v = 0; v < valves.size(); ++v) {
      if ((who >> v) % 2 == 0) continue;
      Twins& valve = valves[v];
      valve.samples.resize(alike ? common : length());
      for (TimedSample& sample : valve.samples) sample = valve.next();
      valve.answers.assign(valve.samples.size(), {});
      runs.push_back({&valve.grouped, valve.samples, valve.answers});
      with.push_back(&valve);
    }
    group.step(runs);
    for (Twins* const valve : with) {
      for (std::size_t k = 0; k < valve->samples.size(); ++k) {
        const sensor::Estimate<double> alone = valve->alone.step(valve->samples[k]);
        met.status |= static_cast<std::uint32_t>(alone.status);
        met.sliding += has(alone.status, sensor::Status::spool_at_rest) ? 0 : 1;
        if (same_bytes(valve->answers[k], alone) || ++met.apart > 1) continue;
        ADD_FAILURE() << "round " << round << ", valve " << valve - valves.data() << ", sample " << k << ": flow "
                      << valve->answers[k].flow_m3_per_s << ", alone " << alone.flow_m3_per_s << ", status "
                      << static_cast<std::uint32_t>(valve->answers[k].status) << ", alone "
                      << static_cast<std::uint32_t>(alone.status);
      }
      const std::string other = difference(valve->grouped.state(), valve->alone.state());
      if (other.empty() || ++met.apart > 1) continue;
      ADD_FAILURE() << "round " << round << ", valve " << valve - valves.data() << " remembers something else, "
                    << other;
    }
    if (met.apart > 0) return met;
  }
  return met;
}

/// What a valve measures that strokes, holds and creeps, here and there under dither; `way` 1 or -1. Now and then an
/// input is missing or broken, the time repeats, runs backwards or leaps, the position jumps or hangs.
class Course {
 public:
  Course(unsigned seed, bool whole) : dice_(seed), whole_(whole), step_s_(0.4e-3 * (1 + seed % 4)) {}

  TimedSample next() {
    time_s_ += dice_.one_in(900) ? -0.01 : dice_.one_in(700) ? 0.0 : dice_.one_in(1500) ? 3.0 : step_s_;
    driven_s_ += step_s_;
    const double phase = std::fmod(driven_s_, 3.0);
    const double swing = phase < 0.7 ? std::sin(4.4879895 * phase) : phase < 1.2 ? 0.3 : phase < 1.9 ? 0.6 : 0.0;
    const double stroke = whole_ && std::fmod(driven_s_, 6.0) > 3.0 ? -swing : swing;
    const bool dithers = std::fmod(driven_s_, 2.0) > 1.1;
    const double dither_A = dithers ? 0.12 * std::sin(6.2831853 * 110 * driven_s_) : 0;
    const double size_A = std::abs(stroke) * 1.4 + (std::abs(stroke) > 0 ? 0.35 + dither_A : 0) + noise(2e-3);
    const double jump_m = std::fmod(driven_s_, 2.7) > 2.65 ? 4e-4 : 0;
    TimedSample out{time_s_, size_A, 6 * size_A + noise(0.1), 2.2e-3 * stroke + noise(1e-6) + jump_m,
                    unless(30, 310 + 5 * std::sin(driven_s_))};
    if (dithers) out.position_m += 5e-6 * std::sin(6.2831853 * 110 * driven_s_ - 1);
    if (whole_) {
      const double other_A = std::abs(stroke) < 0.1 ? std::abs(0.3 + noise(0.01)) : noise(1e-3);
      out.current_A = stroke < 0 ? other_A : size_A;
      out.current_a_A = unless(400, stroke < 0 ? size_A : other_A);
      out.voltage_a_V = unless(50, 6 * out.current_a_A);
    }
    out.current_A = unless(300, out.current_A);
    out.voltage_V = unless(100, out.voltage_V);
    out.position_m = unless(400, out.position_m);
    if (std::fmod(driven_s_, 11.0) > 10.8) out.position_m = 1.1e-3;
    if (std::fmod(driven_s_, 13.0) > 12.5) out.voltage_V = 20;
    return out;
  }

 private:
  double noise(double size) { return size * (dice_.share() + dice_.share() + dice_.share() - 1.5) * 2; }
  double unless(unsigned rare, double value) { return dice_.one_in(rare) ? nan : value; }

  Dice dice_;
  bool whole_;
  double step_s_, time_s_ = 0, driven_s_ = 0;
};

class RunningGroups : public testing::TestWithParam<GroupRegisters> {};
INSTANTIATE_TEST_SUITE_P(Group, RunningGroups, testing::ValuesIn(group_registers()), [](const auto& registers) {
  std::string out(name(registers.param));
  std::erase_if(out, [](char letter) { return letter == ' ' || letter == '-'; });
  return out;
});

void expect_met(const Met& met, std::initializer_list<sensor::Status> bits) {
  for (const sensor::Status bit : bits)
    EXPECT_TRUE(has(static_cast<sensor::Status>(met.status), bit)) << static_cast<std::uint32_t>(bit);
}

/// Each of another seed, so that rates and courses differ. `begin` makes a sensor as new.
std::vector<Twins> on_courses(std::size_t count, bool whole, const std::function<RunningSensor(std::size_t)>& begin) {
  std::vector<Twins> out;
  for (std::size_t v = 0; v < count; ++v) {
    const auto course = std::make_shared<Course>(static_cast<unsigned>(v + 3), whole);
    out.push_back({begin(v), begin(v), [course] { return course->next(); }});
  }
  return out;
}

TEST_P(RunningGroups, AnswerAndRememberWhatEachSensorOfOneDirectionDoesByItself) {
  const model::Model model = model::read_model(SPOOLFLOW_EXAMPLES "/live/size_6.json");
  // Models that are all unlike, beside some that are the same.
  std::vector<model::Model> models(5, model);
  for (std::size_t m = 1; m < models.size(); ++m) {
    auto& valve = models[m].observer->parameters;
    const double scale = 1 + 0.03 * static_cast<double>(m);
    for (double& number : valve.actuator.magnetic_force.map.values) number *= scale;
    for (double& number : valve.edge.conductance.values) number /= scale;
    for (double& number : valve.spring.curve.values) number += 0.1 * static_cast<double>(m);
  }
  auto valves = on_courses(
      13, false, [&](std::size_t v) { return running_sensor(models[v % models.size()], Estimator::observer); });
  const Met met = run(valves, 400, GetParam(), 1);
  EXPECT_EQ(met.apart, 0U);
  EXPECT_GT(met.sliding, 5000U);
  using sensor::Status;
  expect_met(met, {Status::closed, Status::spool_at_rest, Status::dithered, Status::position_fault,
                   Status::sample_missing, Status::time_fault, Status::coil_fault});
}

TEST_P(RunningGroups, AnswerAndRememberWhatEachWholeValveDoesByItself) {
  const model::Model model = model::read_model(SPOOLFLOW_EXAMPLES "/position_control/whole_size_6.json");
  std::vector<model::Model> models(3, model);
  models[1].observer->parameters.unsettled_load_share = 0.3;  // of some, a load that settles
  models[2].observer->parameters.closed_below_m = models[2].p_to_a->observer->parameters.closed_below_m = 0;
  auto valves = on_courses(11, true, [&](std::size_t v) { return running_sensor(models[v % 3], Estimator::observer); });
  const Met met = run(valves, 400, GetParam(), 2);
  EXPECT_EQ(met.apart, 0U);
  EXPECT_GT(met.sliding, 5000U);
  using sensor::Status;
  expect_met(met, {Status::closed, Status::spool_at_rest, Status::dithered, Status::sign_undetermined,
                   Status::position_fault, Status::sample_missing, Status::time_fault});
}

TEST_P(RunningGroups, TakeWhateverModelsAndSamplesThereMayBe) {
  std::vector<model::Model> models;
  std::vector<Dice> dice;
  constexpr std::size_t count = 24;
  for (std::size_t v = 0; v < count; ++v) {
    models.push_back(random_model(1000 + v));
    if (v % 3 == 0) models.back().p_to_a = {random_model(2000 + v).condensed, random_model(3000 + v).observer, {}};
    dice.emplace_back(v);
  }
  std::vector<Twins> valves;
  for (std::size_t v = 0; v < count; ++v) {
    const auto& valve = models[v].observer->parameters;
    const auto samples = std::make_shared<RandomSamples>(dice[v], largest_current_A(valve), largest_position_m(valve));
    const bool whole = models[v].whole();
    valves.push_back({running_sensor(models[v], Estimator::observer), running_sensor(models[v], Estimator::observer),
                      [samples, whole, &chance = dice[v]] {
                        TimedSample out = samples->next();
                        if (whole && chance.one_in(2)) out.position_m = -out.position_m;
                        if (whole && !chance.one_in(3)) out.current_a_A = samples->next().current_A;
                        if (whole && chance.one_in(2000)) out.ports = {90e5, 50e5, 40e5, 1e5};
                        return out;
                      }});
  }
  const Met met = run(valves, 300, GetParam(), 3);
  EXPECT_EQ(met.apart, 0U);
  expect_met(met, {sensor::Status::temperature_fault, sensor::Status::coil_fault});
}

TEST_P(RunningGroups, LeaveAloneWhatIsNoObserver) {
  const model::Model model = model::read_model(SPOOLFLOW_EXAMPLES "/live/size_6.json");
  auto valves = on_courses(5, false, [&](std::size_t v) {
    return running_sensor(model, v % 2 == 0 ? Estimator::condensed : Estimator::observer);
  });
  EXPECT_EQ(run(valves, 20, GetParam(), 4).apart, 0U);
}

TEST(RunningGroup, RefusesRoomForOtherAnswersThanSamples) {
  const model::Model model = model::read_model(SPOOLFLOW_EXAMPLES "/live/size_6.json");
  RunningSensor sensor = running_sensor(model, Estimator::observer);
  const std::vector<TimedSample> samples(3);
  std::vector<sensor::Estimate<double>> answers(2);
  EXPECT_THROW(RunningGroup().step(std::vector<GroupedRun>{{&sensor, samples, answers}}), std::invalid_argument);
}

}  // namespace
}  // namespace spoolflow::estimation

/// Blocks of several valves worked on together against the same blocks worked on by each valve alone: what is kept,
/// told and shown.
#include "addons/live/work_together.hpp"

#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "addons/live/blocks/block.hpp"
#include "spoolflow/model/model.hpp"

namespace spoolflow::live {
namespace {

SharedModel shared(const char* file) {
  return {std::make_shared<const model::Model>(model::read_model(std::string(SPOOLFLOW_EXAMPLES) + file)), file};
}

/// A valve that strokes slowly at its own pace; now and then its position is missing.
class Strokes {
 public:
  Strokes(unsigned seed, bool whole) : random_(seed), whole_(whole), period_s_(1.5 + 0.2 * seed) {}

  SampleBlock next() {
    SampleBlock out{.arrived_ns = static_cast<std::int64_t>(++blocks_)};
    const std::size_t count = random_() % 60;
    for (std::size_t k = 0; k < count; ++k) out.samples.push_back(sample());
    out.after = {7, samples_};
    return out;
  }

 private:
  estimation::TimedSample sample() {
    const double time_s = 1e-3 * static_cast<double>(samples_++);
    const double phase = 2 * std::numbers::pi * time_s / period_s_;
    const double stroke = whole_ ? std::sin(phase) : 0.5 - 0.5 * std::cos(phase);
    const double drag_A = 0.05 * (std::sin(phase) > 0 ? 1 : -1);
    const double size_A = 0.3 + 1.2 * std::abs(stroke) + drag_A + noise(1e-3);
    estimation::TimedSample out{time_s, size_A, 6 * size_A, 1.8e-3 * stroke + noise(1e-6), 313 + noise(0.1)};
    if (whole_) {
      out.current_A = stroke > 0 ? size_A : 0;
      out.current_a_A = stroke > 0 ? 0 : size_A;
      out.voltage_V = 6 * out.current_A;
      out.voltage_a_V = 6 * out.current_a_A;
    }
    if (random_() % 500 == 0) out.position_m = estimation::not_measured;
    return out;
  }
  double noise(double size) { return size * (static_cast<double>(random_() % 2001) / 1000 - 1); }

  std::mt19937 random_;
  bool whole_;
  double period_s_;
  std::uint64_t samples_ = 0, blocks_ = 0;
};

/// Everything that is kept, told and shown of a valve, numbers by their bits.
std::string all_of(ValveAtWork& valve, bool with_indicators) {
  const auto number = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  std::string out;
  const ValveView view = valve.view();
  out += fmt::format("{} {} {} {} {} {} {}\n", number(view.time_s), number(view.answer.flow_m3_per_s),
                     number(view.answer.flow_upper_m3_per_s), view.samples, number(view.energy_J), view.arrived_ns,
                     view.doubted);
  const ValveAtWork::TracePart trace = valve.trace_from(0);
  out += fmt::format("{} points, {}\n", valve.trace_size(), trace.points.size());
  out += valve.raw_csv(0, 1e9);
  const ValveCommit commit = valve.take_commit(with_indicators);
  const Summary& row = commit.since_last;
  out += fmt::format("{} {} {} {} {} {} {} {} {}\n", row.samples, number(row.time_s), number(row.flow_min_m3_per_s),
                     number(row.flow_mean_m3_per_s), number(row.flow_max_m3_per_s), number(row.lower_min_m3_per_s),
                     number(row.upper_max_m3_per_s), number(row.energy_J), row.status);
  for (const OutboxBlock& block : commit.blocks) {
    out += fmt::format("block {}:", block.number);
    fleet::Block written = std::get<fleet::Block>(fleet::read_block(block.bytes));
    written.wall_ms = 0;  // when it was cut
    for (const std::uint8_t byte : fleet::write_block(written)) out += fmt::format(" {}", byte);
    out += '\n';
  }
  for (const KeptIndicator& one : commit.indicators)
    out += fmt::format("{} {} {} {}\n", one.name, number(one.value), number(one.uncertainty_95), one.state);
  out += fmt::format("{} {} {}:", commit.state.session, commit.state.next, commit.state.samples);
  for (const std::byte byte : commit.state.bytes) out += fmt::format(" {}", static_cast<int>(byte));
  return out;
}

TEST(WorkTogether, KeepsTellsAndShowsOfEachValveWhatItDoesAlone) {
  const SharedModel size_6 = shared("/live/size_6.json"), whole = shared("/position_control/whole_size_6.json");
  constexpr std::size_t valves = 19;
  std::vector<std::unique_ptr<ValveAtWork>> together, alone;
  std::vector<Strokes> strokes;
  for (std::size_t v = 0; v < valves; ++v) {
    const bool is_whole = v % 4 == 3;
    for (auto* const side : {&together, &alone}) {
      side->push_back(std::make_unique<ValveAtWork>(fmt::format("v{}", v), is_whole ? whole : size_6, "test", 1));
      if (v % 5 == 1) side->back()->publish(fmt::format("hall/v{}", v), {.session = 1}, {.longest_s = 0.5});
    }
    strokes.emplace_back(static_cast<unsigned>(v), is_whole);
  }
  std::mt19937 random(5);
  WorkTogether work;
  std::size_t published = 0, judged = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<SampleBlock> blocks(valves);
    std::vector<ValveTurn> turns;
    const bool all = round % 3 == 0;
    for (std::size_t v = 0; v < valves; ++v) {
      if (!all && random() % 2 == 0) continue;
      blocks[v] = strokes[v].next();
      turns.push_back({together[v].get(), &blocks[v]});
      alone[v]->work(blocks[v]);
    }
    work.work(turns);
    if (round % 50 != 49) continue;
    for (std::size_t v = 0; v < valves; ++v) {
      const std::string expected = all_of(*alone[v], round % 100 == 99);
      ASSERT_TRUE(all_of(*together[v], round % 100 == 99) == expected) << "valve " << v << " in round " << round;
      published += expected.find("block ") != std::string::npos ? 1 : 0;
      judged += expected.find("friction") != std::string::npos ? 1 : 0;
    }
  }
  EXPECT_GT(published, 5U);
  EXPECT_GT(judged, 5U);
}

}  // namespace
}  // namespace spoolflow::live

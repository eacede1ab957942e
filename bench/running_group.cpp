/// Running sensors in double precision: one after the other, and together in SIMD registers, in one run; blocks of
/// samples as they come in `live`, each with loading and storing of the valves' states.
/// running_group MODEL.json RECORDING [SAMPLES_OF_A_BLOCK=100]
#include "spoolflow/estimation/running_group.hpp"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/estimation/columns.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/model/model.hpp"
#include "spoolflow/validation/sensor_channels.hpp"

namespace {

using namespace spoolflow;
constexpr std::size_t samples_of_a_valve = 4000;
constexpr int rounds = 30;

/// Processor time of this thread [ns]: others may keep the machine busy.
double now_ns() {
  timespec time{};
  (void)::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  constexpr double ns_per_s = 1e9;
  return ns_per_s * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

std::vector<estimation::TimedSample> samples_of(const char* recording, const model::Model& model) {
  std::vector<estimation::TimedSample> out;
  recording::SampleBlock block;
  const auto reader = validation::open_sensor_channels(recording, validation::sensor_channels(model, {}));
  while (reader->next(block)) {
    const estimation::Columns columns = validation::sensor_columns(block);
    for (std::size_t k = 0; k < columns.size(); ++k) out.push_back(columns[k]);
  }
  return out;
}

/// Each valve with a model of its own and from another moment of the recording on.
class Hall {
 public:
  Hall(const model::Model& model, const std::vector<estimation::TimedSample>& recorded, std::size_t valves)
      : models_(valves, model), samples_(valves) {
    for (std::size_t v = 0; v < valves; ++v) {
      sensors_.push_back(estimation::running_sensor(models_[v], estimation::Estimator::observer));
      const double step_s = recorded[1].time_s - recorded[0].time_s;
      for (std::size_t k = 0; k < samples_of_a_valve; ++k) {
        samples_[v].push_back(recorded[(k + v * recorded.size() / valves) % recorded.size()]);
        samples_[v].back().time_s = step_s * static_cast<double>(k);
      }
    }
  }
  /// Nanoseconds a sample and valve.
  double time(estimation::RunningGroup& group, std::size_t samples_of_a_block) {
    std::vector<std::vector<sensor::Estimate<double>>> answers(sensors_.size());
    for (auto& one : answers) one.resize(samples_of_a_block);
    std::vector<estimation::GroupedRun> runs(sensors_.size());
    for (estimation::RunningSensor& one : sensors_) one.reset();
    const double begun_ns = now_ns();
    std::size_t done = 0;
    for (; done + samples_of_a_block <= samples_of_a_valve; done += samples_of_a_block) {
      for (std::size_t v = 0; v < sensors_.size(); ++v)
        runs[v] = {&sensors_[v], std::span(samples_[v]).subspan(done, samples_of_a_block), answers[v]};
      group.step(runs);
    }
    return (now_ns() - begun_ns) / static_cast<double>(done * sensors_.size());
  }

 private:
  std::vector<model::Model> models_;
  std::vector<std::vector<estimation::TimedSample>> samples_;
  std::vector<estimation::RunningSensor> sensors_;
};

void measure(const model::Model& model, const std::vector<estimation::TimedSample>& recorded,
             std::size_t samples_of_a_block) {
  std::vector<estimation::RunningGroup> groups;
  fmt::print("Nanoseconds a sample and valve of the {}, in blocks of {} samples, each valve its own model\n{:>6}",
             model.whole() ? "whole valve" : "observer", samples_of_a_block, "valves");
  for (const auto registers : estimation::group_registers()) {
    groups.emplace_back(registers);
    fmt::print("{:>16}", estimation::name(registers));
  }
  fmt::print("\n");
  for (const std::size_t valves : {1U, 2U, 3U, 4U, 5U, 6U, 8U, 16U}) {
    Hall hall(model, recorded, valves);
    std::vector<double> least_ns(groups.size(), std::numeric_limits<double>::infinity());
    for (int round = 0; round < rounds; ++round) {
      for (std::size_t g = 0; g < groups.size(); ++g)
        least_ns[g] = std::min(least_ns[g], hall.time(groups[g], samples_of_a_block));
    }
    fmt::print("{:>6}", valves);
    for (const double ns : least_ns) fmt::print("{:>9.1f} ({:>3.0f} %)", ns, 100 * ns / least_ns.front());
    fmt::print("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: running_group MODEL.json RECORDING [SAMPLES_OF_A_BLOCK=100]\n");
    return 2;
  }
  try {
    const model::Model model = model::read_model(argv[1]);
    measure(model, samples_of(argv[2], model), argc > 3 ? static_cast<std::size_t>(std::atoi(argv[3])) : 100);
  } catch (const std::exception& error) {
    fmt::print(stderr, "running_group: {}\n", error.what());
    return 1;
  }
  return 0;
}

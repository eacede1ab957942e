/// The sensors over samples that are in memory. estimate_in_memory MODEL.json RECORDING [ROUNDS=5] prints the least
/// processor time of each estimator [s]: with every answer in an array that is there afterwards, and with each block's
/// answers in the place of those before, as `spoolflow estimate` has it between reading and writing:
/// "observer 0.452 0.412".
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"

namespace {

using namespace spoolflow;

/// Processor time [s].
double run_s(const model::Model& model, estimation::Estimator estimator,
             const std::vector<recording::SampleBlock>& blocks, bool kept) {
  std::size_t all = 0, largest = 0;
  for (const recording::SampleBlock& block : blocks) {
    all += block.rows;
    largest = std::max(largest, block.rows);
  }
  const std::clock_t begun = std::clock();
  std::vector<sensor::Estimate<double>> estimates(kept ? all : largest);
  estimation::RunningSensor sensor = estimation::running_sensor(model, estimator);
  std::size_t place = 0;
  for (const recording::SampleBlock& block : blocks) {
    estimation::run(sensor, estimation::sensor_columns(block), std::span(estimates).subspan(place, block.rows));
    if (kept) place += block.rows;
  }
  return static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: estimate_in_memory MODEL.json RECORDING [ROUNDS=5]\n");
    return 2;
  }
  try {
    const model::Model model = model::read_model(argv[1]);
    const int rounds = argc > 3 ? std::atoi(argv[3]) : 5;
    std::vector<recording::SampleBlock> blocks(1);
    const auto reader = estimation::open_sensor_channels(argv[2], estimation::sensor_channels(model, {}));
    while (reader->next(blocks.back())) blocks.emplace_back();
    for (const estimation::Estimator estimator : estimation::all_estimators(model)) {
      fmt::print("{}", name(estimator));
      for (const bool kept : {true, false}) {
        double fastest_s = 1e9;
        for (int round = 0; round < rounds; ++round)
          fastest_s = std::min(fastest_s, run_s(model, estimator, blocks, kept));
        fmt::print(" {:.4f}", fastest_s);
      }
      fmt::print("\n");
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "estimate_in_memory: {}\n", error.what());
    return 1;
  }
  return 0;
}

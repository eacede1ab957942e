/// What `spoolflow estimate` does between reading and writing: the sensors over samples that are in memory.
/// estimate_in_memory MODEL.json RECORDING [ROUNDS=5] prints the least processor time of each estimator [s]:
/// "observer 0.412".
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <vector>

#include <fmt/format.h>

#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/validation/sensor_channels.hpp"

int main(int argc, char** argv) {
  using namespace spoolflow;
  if (argc < 3) {
    fmt::print(stderr, "usage: estimate_in_memory MODEL.json RECORDING [ROUNDS=5]\n");
    return 2;
  }
  try {
    const model::Model model = model::read_model(argv[1]);
    const int rounds = argc > 3 ? std::atoi(argv[3]) : 5;
    std::vector<recording::SampleBlock> blocks(1);
    const auto reader = validation::open_sensor_channels(argv[2], validation::sensor_channels(model, {}));
    while (reader->next(blocks.back())) blocks.emplace_back();
    for (const estimation::Estimator estimator : estimation::all_estimators(model)) {
      double fastest_s = 1e9;
      for (int round = 0; round < rounds; ++round) {
        std::vector<sensor::Estimate<double>> estimates;
        const std::clock_t begun = std::clock();
        estimation::RunningSensor sensor = estimation::running_sensor(model, estimator);
        for (const recording::SampleBlock& block : blocks) {
          estimates.resize(block.rows);
          estimation::run(sensor, validation::sensor_columns(block), estimates);
        }
        fastest_s = std::min(fastest_s, static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC);
      }
      fmt::print("{} {:.4f}\n", name(estimator), fastest_s);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "estimate_in_memory: {}\n", error.what());
    return 1;
  }
  return 0;
}

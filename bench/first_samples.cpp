/// What the check of senders' first samples costs `spoolflow live`: processor seconds, user and system, with it and
/// without. first_samples MODEL.json RECORDING [VALVES=1000] [SECONDS=600] The recording, whose spool moves, goes round
/// and round to every valve in blocks of 20 samples.
#include "addons/live/first_samples.hpp"

#include <chrono>
#include <cstdlib>
#include <string>
#include <sys/resource.h>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "addons/live/sources/csv_stream.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"

namespace {

using namespace spoolflow;

double processor_s() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

std::vector<estimation::TimedSample> samples_of(const std::string& file, const model::Model& model) {
  std::vector<estimation::TimedSample> out;
  const auto reader = estimation::open_sensor_channels(file, estimation::sensor_channels(model, {}));
  recording::SampleBlock block;
  while (reader->next(block)) {
    const std::vector<estimation::TimedSample> more = live::samples_of(block);
    out.insert(out.end(), more.begin(), more.end());
  }
  return out;
}

/// Sends to all valves, or only makes what would be sent.
double cost_s(const live::SiteSettings& site, const std::vector<estimation::TimedSample>& samples, double seconds,
              bool checked) {
  constexpr std::size_t block_samples = 20;
  const double period_s = samples[1].time_s - samples[0].time_s;
  const double round_s = samples.back().time_s - samples.front().time_s + period_s;
  live::FirstSamples checks(site);
  live::SampleBlock block{.counted = {.connections = 1}};
  const double before = processor_s();
  const auto blocks = static_cast<std::size_t>(seconds / (period_s * static_cast<double>(block_samples)));
  for (std::size_t k = 0, at = 0; k < blocks; ++k) {
    block.samples.clear();
    for (std::size_t row = 0; row < block_samples; ++row, ++at) {
      block.samples.push_back(samples[at % samples.size()]);
      block.samples.back().time_s += round_s * static_cast<double>(at / samples.size());
    }
    for (std::size_t valve = 0; checked && valve < site.valves.size(); ++valve) checks.take(valve, block);
  }
  std::this_thread::sleep_for(std::chrono::seconds(2));  // the last judgements
  return processor_s() - before;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "first_samples MODEL.json RECORDING [VALVES=1000] [SECONDS=600]\n");
    return 2;
  }
  const int valves = argc > 3 ? std::atoi(argv[3]) : 1000;
  const double seconds = argc > 4 ? std::atof(argv[4]) : 600;
  const live::SharedModel model{std::make_shared<const model::Model>(model::read_model(argv[1])), "model"};
  const std::vector<estimation::TimedSample> samples = samples_of(argv[2], *model.model);
  live::SiteSettings site;
  for (int k = 0; k < valves; ++k) site.valves.push_back({fmt::format("v{}", k), model, live::UdpSettings{}});
  const double without_s = cost_s(site, samples, seconds, false), with_s = cost_s(site, samples, seconds, true);
  fmt::print("{} valves, {} s of their samples: {:.2f} processor seconds with the check, {:.2f} without\n", valves,
             seconds, with_s, without_s);
}

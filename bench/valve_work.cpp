/// What the work on one valve's samples takes in `live` and in a worker of a fleet, and how much of it is the sensor.
/// valve_work MODEL.json RECORDING; of a model of one direction.
#include <algorithm>
#include <ctime>
#include <exception>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "addons/live/blocks/block.hpp"
#include "addons/live/blocks/steps.hpp"
#include "addons/live/valve/valve_at_work.hpp"
#include "spoolflow/estimation/estimator.hpp"
#include "spoolflow/recording/reader.hpp"

namespace {

using namespace spoolflow;
constexpr int rounds = 9;
constexpr std::size_t samples_of_a_block = 1000;

struct Taken {
  double decoding_ns = 0, sensor_ns = 0, work_ns = 0;
  volatile double flow_m3_per_s = 0;  ///< is asked for, so that the sensor has to work
};

/// Processor time of this thread: others may keep the machine busy.
double now_ns() {
  timespec time{};
  (void)::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  constexpr double ns_per_s = 1e9;
  return ns_per_s * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

std::vector<estimation::TimedSample> samples_of(const std::string& file) {
  using recording::Channel;
  const recording::Recording read = recording::read_recording(file, {});
  std::vector<estimation::TimedSample> out;
  for (std::size_t k = 0; k < read.size(); ++k) {
    estimation::TimedSample sample{};
    sample.time_s = read[Channel::time][k];
    sample.current_A = read[Channel::current][k];
    sample.voltage_V = read[Channel::voltage][k];
    sample.position_m = read[Channel::position][k];
    sample.oil_temperature_K = read[Channel::oil_temperature][k];
    sample.current_a_A = sample.voltage_a_V = estimation::not_measured;
    out.push_back(fleet::on_grid(sample));
  }
  return out;
}

Taken one_round(const live::SharedModel& model, const std::vector<estimation::TimedSample>& samples) {
  Taken out;
  estimation::RunningSensor sensor = estimation::running_sensor(*model.model, estimation::best_estimator(*model.model));
  live::ValveAtWork valve("v", model, "bench");
  std::size_t worked = 0;
  for (std::uint64_t number = 1; number * samples_of_a_block <= samples.size(); ++number) {
    const auto* const first = samples.data() + (number - 1) * samples_of_a_block;
    fleet::Block block{.valve = "hall/v", .model_sha256 = model.sha256, .session = 1, .number = number};
    block.first = number;
    block.samples.assign(first, first + samples_of_a_block);
    const std::vector<std::uint8_t> bytes = fleet::write_block(block);
    double begun_ns = now_ns();
    const auto read = std::get<fleet::Block>(fleet::read_block(bytes));
    out.decoding_ns += now_ns() - begun_ns;
    begun_ns = now_ns();
    for (const estimation::TimedSample& sample : read.samples) out.flow_m3_per_s = sensor.step(sample).flow_m3_per_s;
    out.sensor_ns += now_ns() - begun_ns;
    begun_ns = now_ns();
    valve.work({read.samples, {1, number + 1}, 1});
    (void)valve.take_summary();
    (void)valve.view(false);
    out.work_ns += now_ns() - begun_ns;
    worked += samples_of_a_block;
  }
  const auto count = static_cast<double>(worked);
  for (double* const taken : {&out.decoding_ns, &out.sensor_ns, &out.work_ns}) *taken /= count;
  return out;
}

void measure(char** arguments) {
  const live::SharedModel model{std::make_shared<const model::Model>(model::read_model(arguments[1])),
                                std::string(64, 'a')};
  const auto samples = samples_of(arguments[2]);
  Taken least{1e9, 1e9, 1e9};
  for (int round = 0; round < rounds; ++round) {
    const Taken now = one_round(model, samples);
    least.decoding_ns = std::min(least.decoding_ns, now.decoding_ns);
    least.sensor_ns = std::min(least.sensor_ns, now.sensor_ns);
    least.work_ns = std::min(least.work_ns, now.work_ns);
  }
  fmt::print(
      "nanoseconds a sample: a block decoded {:.0f}, a valve's work {:.0f}, of which the sensor {:.0f} ({:.0f} %)\n",
      least.decoding_ns, least.work_ns, least.sensor_ns, 100 * least.sensor_ns / least.work_ns);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  try {
    measure(argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "valve_work: {}\n", error.what());
    return 1;
  }
}

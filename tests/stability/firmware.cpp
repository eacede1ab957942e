/// A firmware as it was written for the release, by docs/embedded.md: what it names stays. `firmware PAGE RUN.csv`
/// prints the flow [m3/s] and the status of each row of the run (names as in names of channels, SI but for mm and
/// degC), or the code of the page's refusal and exit status 3.
#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "spoolflow/sensor/dither_request.hpp"
#include "spoolflow/sensor/fieldbus/can_answer.hpp"
#include "spoolflow/sensor/observer.hpp"
#include "spoolflow/sensor/parameter_image/parameters_from.hpp"

namespace sensor = spoolflow::sensor;

namespace {

sensor::ValveParameters valve;
sensor::ObserverState<float> state;
sensor::DitherRequestState<float> dither_memory;
constexpr sensor::DitherRequestParameters<float> limits{2.7e-5F, 0.08F, 0.31F, 125.0F, 0.5F, 0.0F};

std::vector<std::uint64_t> words_of(const char* file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::vector<std::uint64_t> out((bytes.size() + 7) / 8);
  bytes.copy(reinterpret_cast<char*>(out.data()), bytes.size());
  return out;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 1;
  const std::vector<std::uint64_t> page = words_of(arguments[1]);
  const sensor::ImageRefusal refusal = parameters_from(page.data(), 8 * page.size(), valve);
  if (refusal != sensor::ImageRefusal::none || valve.observer_b == nullptr) {
    std::printf("%u\n", static_cast<unsigned>(refusal));
    return 3;
  }
  std::ifstream run(arguments[2]);
  std::string line;
  std::getline(run, line);
  double last_s = 0;
  while (std::getline(run, line)) {
    std::array<double, 5> in{};
    std::istringstream cells(line);
    for (double& cell : in) {
      std::string text;
      std::getline(cells, text, ',');
      cell = std::stod(text);
    }
    sensor::Sample<float> sample{};
    sample.time_step_s = static_cast<float>(in[0] - (last_s == 0 ? in[0] : last_s));
    sample.current_A = static_cast<float>(in[1]);
    sample.voltage_V = static_cast<float>(in[2]);
    sample.position_m = static_cast<float>(1e-3 * in[3]);
    sample.oil_temperature_K = static_cast<float>(in[4] + 273.15);
    last_s = in[0];
    const sensor::Estimate<float>& estimate = step(*valve.observer_b, state, sample);
    const auto request = request_dither(limits, dither_memory, *valve.observer_b, state, sample.time_step_s);
    const sensor::FlowAnswer answer = sensor::flow_answer(estimate, valve.header->rated_flow_m3_per_s);
    const auto frame = sensor::process_data_frame(answer, 17);
    if (estimate.flow_lower_m3_per_s > estimate.flow_upper_m3_per_s || frame.size != 8 || request.amplitude_A < 0)
      return 1;
    std::printf("%.9g %u\n", static_cast<double>(estimate.flow_m3_per_s), static_cast<unsigned>(estimate.status));
  }
  return (static_cast<std::uint32_t>(state.last.status) & sensor::fault_bits) == 0 ? 0 : 4;
}

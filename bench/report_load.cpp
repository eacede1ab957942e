/// A site that estimates by itself, as far as a fleet sees it: reports of so many valves, one a second each, evenly
/// over the second, to a stream; once a minute with indicators. bench/fleet_growth.py holds what a fleet makes of them.
/// report_load SERVER MODEL.json VALVES SECONDS
/// Nothing is sent again: reports that a server loses are missing.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "addons/fleet/models.hpp"
#include "addons/fleet/subjects.hpp"
#include "addons/fleet/transport/nats.hpp"
#include "addons/live/blocks/block.hpp"
#include "spoolflow/model/provenance.hpp"

namespace {

using namespace spoolflow;
using std::chrono::steady_clock;
constexpr const char* site = "yard";
constexpr int minute = 60;

/// Of one valve and second: figures that differ from second to second, as those of a valve at work do.
fleet::SiteReport report(int valve, int second) {
  fleet::SiteReport out;
  constexpr std::int64_t samples = 1000;
  const double flow = 1e-4 + 1e-7 * ((valve * 37 + second * 101) % 997);
  out.summary = {.samples = samples,
                 .time_s = second + 0.001 * (valve % 1000),
                 .flow_min_m3_per_s = 0.9 * flow,
                 .flow_mean_m3_per_s = flow,
                 .flow_max_m3_per_s = 1.1 * flow,
                 .lower_min_m3_per_s = 0.8 * flow,
                 .upper_max_m3_per_s = 1.2 * flow,
                 .energy_J = 6e6 * flow};
  out.samples = static_cast<std::uint64_t>(samples) * static_cast<std::uint64_t>(second + 1);
  out.energy_J = 6e6 * flow * (second + 1);
  if ((second + valve) % minute != 0) return out;
  for (const char* name :
       {"friction_ratio", "edge_rounding", "spring_preload", "spring_rate", "turns_ratio", "resistance_20C",
        "hysteresis_width", "centre_position", "response_time", "dither_swing", "strokes", "distance"}) {
    out.indicators.push_back({.name = name,
                              .value = 1 + 0.001 * ((valve + second) % 91),
                              .uncertainty_95 = 0.05,
                              .baseline = 1,
                              .state = "good",
                              .unit = "1"});
  }
  return out;
}

void send(fleet::Connection& nats, const std::string& sha256, int valves, int seconds) {
  const auto begin = steady_clock::now();
  std::uint64_t sent = 0, bytes = 0;
  double late_s = 0;
  for (int second = 0; second < seconds; ++second) {
    for (int valve = 0; valve < valves; ++valve) {
      const auto due = begin + std::chrono::duration_cast<steady_clock::duration>(
                                   std::chrono::duration<double>(second + static_cast<double>(valve) / valves));
      if (steady_clock::now() < due) std::this_thread::sleep_until(due);
      fleet::Block block;
      block.valve = fmt::format("{}/v{}", site, valve);
      block.model_sha256 = sha256;
      block.number = block.first = static_cast<std::uint64_t>(second) + 1;
      block.wall_ms =
          std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::system_clock::now().time_since_epoch())
              .count();
      block.report = report(valve, second);
      const std::vector<std::uint8_t> written = fleet::write_block(block);
      bytes += written.size();
      sent += nats.publish(fleet::block_subject(fleet::partition_of(block.valve), site), written) ? 1 : 0;
      late_s = std::max(late_s, std::chrono::duration<double>(steady_clock::now() - due).count());
    }
  }
  fmt::print("{} reports sent, {} bytes each, at most {:.2f} s late\n", sent, bytes / std::max<std::uint64_t>(sent, 1),
             late_s);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    fmt::print(stderr, "usage: report_load SERVER MODEL.json VALVES SECONDS\n");
    return 2;
  }
  try {
    std::ifstream file(argv[2], std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::string sha256 = model::sha256_of_text(text);
    const std::vector<std::uint8_t> packed = fleet::pack_model(text);
    fleet::Connection nats({.servers = {argv[1]}}, "report_load");
    while (!nats.connected()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    nats.publish(fleet::model_subject(site), sha256 + std::string(packed.begin(), packed.end()));
    send(nats, sha256, std::atoi(argv[3]), std::atoi(argv[4]));
    std::this_thread::sleep_for(std::chrono::seconds(1));  // what is handed over is on its way
  } catch (const std::exception& error) {
    fmt::print(stderr, "report_load: {}\n", error.what());
    return 1;
  }
  return 0;
}

/// Memory of `spoolflow estimate MODEL - -o -` on an endless recording through a pipe.
/// estimate_memory MODEL.json RECORDING.csv [GiB=5]
#include <csignal>
#include <cstdlib>
#include <exception>
#include <stdexcept>
#include <unistd.h>

#include <fmt/format.h>

#include "bench/child_process.hpp"
#include "bench/endless_recording.hpp"

namespace {

using namespace spoolflow::bench;

int stream_through(const char* model, const char* recording, double GiB) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  // Started before the recording is loaded: what this process holds would count as the command's.
  const std::string command = fmt::format("exec '{}' estimate '{}' - -o - {}<&-", SPOOLFLOW_COMMAND, model, ends[1]);
  ChildProcess estimate({"sh", "-c", command}, {.input = ends[0]});
  ::close(ends[0]);
  const auto bytes = static_cast<std::uint64_t>(GiB * 1024 * 1024 * 1024);
  const std::uint64_t rows = EndlessRecording(recording).write(ends[1], bytes);
  ::close(ends[1]);
  const Cost cost = estimate.finish();
  fmt::print("{:.2f} GiB, {} samples: {:.1f} s, {:.1f} M samples/s, peak memory {:.1f} MiB (wanted: below 64)\n", GiB,
             rows, cost.wall_s, 1e-6 * static_cast<double>(rows) / cost.wall_s, cost.peak_rss_MiB);
  return cost.peak_rss_MiB < 64 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: estimate_memory MODEL.json RECORDING.csv [GiB=5]\n");
    return 2;
  }
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return stream_through(argv[1], argv[2], argc > 3 ? std::strtod(argv[3], nullptr) : 5.0);
  } catch (const std::exception& error) {
    fmt::print(stderr, "estimate_memory: {}\n", error.what());
    return 1;
  }
}

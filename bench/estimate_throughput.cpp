/// `spoolflow estimate` from CSV to CSV against merely parsing the same file (plain_parse), in one run.
/// estimate_throughput MODEL.json RECORDING.csv [MiB=100] [ROUNDS=5]
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <unistd.h>

#include <fmt/format.h>

#include "bench/child_process.hpp"
#include "bench/endless_recording.hpp"

namespace {

namespace fs = std::filesystem;
using spoolflow::bench::ChildProcess;
using spoolflow::bench::EndlessRecording;

int compare(const std::string& model, const std::string& recording, std::uint64_t MiB, int rounds) {
  std::string folder = (fs::temp_directory_path() / "spoolflow-throughput-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
  const std::string input = folder + "/input.csv";
  const int file = ::open(input.c_str(), O_WRONLY | O_CREAT, 0666);
  const std::uint64_t rows = EndlessRecording(recording).write(file, MiB << 20U);
  ::close(file);
  double plain_s = 1e9, estimate_s = 1e9;
  for (int round = 0; round <= rounds; ++round) {
    // What it takes the disk to put a file in the place of another, estimate's six times as large, is neither's.
    for (const char* written : {"/plain.csv", "/estimate.csv"}) fs::remove(folder + written);
    const double plain = ChildProcess({SPOOLFLOW_PLAIN_PARSE, input, folder + "/plain.csv"}, {}).finish().wall_s;
    const double estimate =
        ChildProcess({SPOOLFLOW_COMMAND, "estimate", model, input, "-o", folder + "/estimate.csv"}, {}).finish().wall_s;
    if (round == 0) continue;  // brings programs and file into memory
    plain_s = std::min(plain_s, plain);
    estimate_s = std::min(estimate_s, estimate);
  }
  fs::remove_all(folder);
  const auto show = [&](const char* name, double wall_s) {
    fmt::print("{:<12}{:8.3f} s {:8.1f} MiB/s {:8.2f} M samples/s\n", name, wall_s, static_cast<double>(MiB) / wall_s,
               1e-6 * static_cast<double>(rows) / wall_s);
  };
  fmt::print("{} MiB, {} samples, shortest of {} rounds\n", MiB, rows, rounds);
  show("plain parse", plain_s);
  show("estimate", estimate_s);
  fmt::print("ratio       {:8.2f}   (wanted: at least 0.60)\n", plain_s / estimate_s);
  return plain_s / estimate_s >= 0.6 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: estimate_throughput MODEL.json RECORDING.csv [MiB=100] [ROUNDS=5]\n");
    return 2;
  }
  try {
    return compare(argv[1], argv[2], argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 100,
                   argc > 4 ? std::atoi(argv[4]) : 5);
  } catch (const std::exception& error) {
    fmt::print(stderr, "estimate_throughput: {}\n", error.what());
    return 1;
  }
}

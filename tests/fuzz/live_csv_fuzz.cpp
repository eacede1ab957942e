/// CSV as connections and pipes bring it to `spoolflow live`: bytes, through sensor and monitor.
#include <sys/mman.h>

#include "addons/live/sources/csv_stream.hpp"
#include "spoolflow/estimation/recordings/sensor_channels.hpp"
#include "tests/fuzz/live_valve.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace spoolflow;
  const int file = ::memfd_create("rows", MFD_CLOEXEC);
  if (file < 0 || ::write(file, data, size) != static_cast<::ssize_t>(size)) std::abort();
  ::lseek(file, 0, SEEK_SET);
  static const recording::ReadOptions options = [] {
    recording::ReadOptions out = estimation::sensor_channels(*fuzz::live_model().model, {});
    out.runs_on = true;
    return out;
  }();
  live::Intake intake([] {});
  const std::uint64_t next =
      live::read_csv(std::make_unique<recording::InputBytes>(file, "rows", [] { return false; }), options, 5, intake);
  fuzz::require(next - 5 == intake.counters().received);
  fuzz::work_on_all(intake);
  return 0;
}

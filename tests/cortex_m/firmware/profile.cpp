/// Replays a recording and prints which of its samples takes the most instructions; built again with that sample's
/// number as TRACED_SAMPLE, it steps through this one in code of its own, whose addresses an emulator can trace.
#include "board.hpp"
#include "run_in_flash.hpp"
#include "sensor_under_test.hpp"

namespace {

using Point = PointOf<Sample>;
extern "C" const Point run_points[];

State state;

[[gnu::noinline, gnu::flatten]] void one_step(const Sample& sample) {
  step(parameters, state, sample);
}

/// The same again, where nothing else lies.
[[gnu::section(".text.traced"), gnu::noinline, gnu::flatten, gnu::no_icf]] void traced_step(const Sample& sample) {
  step(parameters, state, sample);
}

}  // namespace

int main() {
  board::start_ticks();
  board::watch_floats();
  const Run& run = run_begin;
  std::uint32_t most = 0, which = 0;
  for (std::uint32_t k = 0; k < run.points; ++k) {
#ifdef TRACED_SAMPLE
    if (k == TRACED_SAMPLE) {
      traced_step(run_points[k].sample);
      return 0;
    }
#endif
    const std::uint32_t before = board::ticks_left;
    one_step(run_points[k].sample);
    const std::uint32_t count = board::instructions((before - board::ticks_left) & 0xFFFFFFU);
    if (count > most) {
      most = count;
      which = k;
    }
  }
  traced_step(run_points[0].sample);
  board::print("largest", most);
  board::print("sample", which);
  return 0;
}

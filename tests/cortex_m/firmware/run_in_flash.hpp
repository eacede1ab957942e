#pragma once
/// The recording that is replayed, in flash as packed_run.hpp lays it out: `run_begin` here, and behind it
/// `run_points`, an array of PointOf<the sensor's sample>, which who replays it declares.
#include <cstdint>

template <class Sample>
struct PointOf {
  Sample sample;
  float golden_m3_per_s;
};
struct Run {
  std::uint32_t points;
  std::uint32_t recorded;  ///< of them; after these come made-up disturbances
};

__asm__(
    ".section .rodata.run\n.balign 8\nrun_begin:\n.incbin \"run.bin\", 0, 8\n"
    "run_points:\n.incbin \"run.bin\", 8\n.balign 4\n.text\n");
extern "C" const Run run_begin;
static_assert(sizeof(Run) == 8);

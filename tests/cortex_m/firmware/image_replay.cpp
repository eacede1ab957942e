/// A recording through the sensor whose numbers come out of a flash page: no model is linked, only the page valve.bin.
/// With EXPORTED_MODEL the same through the exported model. Prints a sum over every bit of all answers, what checking
/// the page and what a step costs. The recording is in flash: see packed_run.hpp.
#include "board.hpp"
#include "run_in_flash.hpp"

#ifdef EXPORTED_MODEL
#include "valve_model.hpp"
#endif

#include "spoolflow/sensor/condensed.hpp"
#include "spoolflow/sensor/observer.hpp"
#include "spoolflow/sensor/parameter_image/parameters_from.hpp"
#include "spoolflow/sensor/whole_valve/whole_condensed.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"

namespace sensor = spoolflow::sensor;

#ifdef REPLAY_WHOLE
using Sample = sensor::WholeValveSample<float>;
using State = sensor::WholeValveState<float>;
using Parameters = sensor::WholeValveParameters<float>;
#elif defined(REPLAY_CONDENSED)
using Sample = sensor::Sample<float>;
using State = sensor::CondensedState<float>;
using Parameters = sensor::CondensedTables<float>;
#else
using Sample = sensor::Sample<float>;
using State = sensor::ObserverState<float>;
using Parameters = sensor::ObserverParameters<float>;
#endif

namespace {

using Point = PointOf<Sample>;
extern "C" const Point run_points[];
static_assert(alignof(Point) <= 8);

State state;

[[gnu::noinline, gnu::flatten]] const sensor::Estimate<float>& one_step(const Parameters& parameters, State& state,
                                                                        const Sample& sample) {
  return step(parameters, state, sample);
}

std::uint32_t instructions_since(std::uint32_t before) {
  return board::instructions((before - board::ticks_left) & 0xFFFFFFU);
}

/// FNV-1a of all bytes of an answer.
std::uint32_t sum_with(std::uint32_t sum, const sensor::Estimate<float>& answer) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(&answer);
  for (std::size_t k = 0; k < sizeof answer; ++k) sum = (sum ^ bytes[k]) * 16777619U;
  return sum;
}

void replay(const Parameters& parameters) {
  constexpr float rated_flow_m3_per_s = RATED_FLOW_M3_PER_S;  // by the test
  float largest_error_m3_per_s = 0.0F;
  std::uint32_t sum = 2166136261U, largest = 0, all = 0;
  for (std::uint32_t k = 0; k < run_begin.points; ++k) {
    const Point& point = run_points[k];
    const std::uint32_t before = board::ticks_left;
    const sensor::Estimate<float>& answer = one_step(parameters, state, point.sample);
    const std::uint32_t count = instructions_since(before);
    if (count > largest) largest = count;
    all += count;
    sum = sum_with(sum, answer);
    const float error_m3_per_s = sensor::magnitude(answer.flow_m3_per_s - point.golden_m3_per_s);
    if (k < run_begin.recorded && error_m3_per_s > largest_error_m3_per_s) largest_error_m3_per_s = error_m3_per_s;
  }
  board::print("points", run_begin.points);
  board::print("answers_sum", sum);
  board::print("largest", largest);
  board::print("mean", all / run_begin.points);
  board::print("error_ppm", static_cast<std::uint32_t>(largest_error_m3_per_s / (1e-6F * rated_flow_m3_per_s)));
}

}  // namespace

#ifdef EXPORTED_MODEL

int main() {
  board::start_ticks();
#ifdef REPLAY_CONDENSED
  const Parameters& parameters = valve_model::condensed;
#else
  const Parameters& parameters = valve_model::observer;
#endif
  replay(parameters);
  return 0;
}

#else

__asm__(
    ".section .rodata.page\n.balign 32\npage_begin:\n.incbin \"valve.bin\"\npage_end:\n"
    ".section .rodata.worn\n.balign 32\nworn_begin:\n.incbin \"worn.bin\"\n.text\n");
extern "C" const unsigned char page_begin[], page_end[], worn_begin[];

namespace {

sensor::ValveParameters valve;

/// Not part of main, so that its stack is seen.
[[gnu::noinline]] sensor::ImageRefusal take_page(std::size_t size) {
  return parameters_from(page_begin, size, valve);
}

/// A page whose bit has fallen is refused, whatever it holds else.
std::uint32_t refusal_of_worn_page(std::size_t size) {
  sensor::ValveParameters none;
  return static_cast<std::uint32_t>(parameters_from(worn_begin, size, none));
}

/// The same page once more in slices of 64 words, as a watch does between samples: its costliest slice.
std::uint32_t costliest_slice(std::size_t size) {
  sensor::ImageCheck check;
  if (begin(check, page_begin, size) != sensor::ImageRefusal::none) return 0;
  std::uint32_t largest = 0;
  for (bool finished = false; !finished;) {
    const std::uint32_t before = board::ticks_left;
    finished = advance(check, 64);
    const std::uint32_t count = instructions_since(before);
    if (count > largest) largest = count;
  }
  return found(check) == sensor::ImageRefusal::none ? largest : 0;
}

}  // namespace

int main() {
  board::start_ticks();
  const auto size = static_cast<std::size_t>(page_end - page_begin);
  board::paint_stack();
  const std::uint32_t before = board::ticks_left;
  const sensor::ImageRefusal refusal = take_page(size);
  board::print("check", instructions_since(before));
  board::print("check_stack_bytes", board::used_stack_bytes());
  board::print("refusal", static_cast<std::uint32_t>(refusal));
  board::print("worn_refusal", refusal_of_worn_page(size));
  board::print("slice", costliest_slice(size));
  board::print("page_bytes", size);
  board::print("parameter_bytes", sizeof valve);
  if (refusal != sensor::ImageRefusal::none) return 1;
#ifdef REPLAY_WHOLE
  const sensor::WholeValveParameters<float> both{valve.observer_b, valve.observer_a};
  replay(both);
#elif defined(REPLAY_CONDENSED)
  replay(*valve.condensed_b);
#else
  replay(*valve.observer_b);
#endif
  return 0;
}

#endif

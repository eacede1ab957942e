/// Replays a recording through the sensor and prints how far its flow is from the host's, what a step costs, and
/// whether a NaN or a denormal came up. The recording is in flash: see packed_run.hpp.
#include "board.hpp"
#include "run_in_flash.hpp"
#include "sensor_under_test.hpp"

namespace {

using Point = PointOf<Sample>;
extern "C" const Point run_points[];
static_assert(alignof(Point) <= 8);

#ifdef __ARM_FP
constexpr std::uint32_t most_instructions = 8192;
#else
constexpr std::uint32_t most_instructions = 98304;
#endif
std::uint32_t histogram[modes][most_instructions];
State state, other_state;

[[gnu::noinline, gnu::flatten]] const spoolflow::sensor::Estimate<float>& one_step(State& state, const Sample& sample) {
  return step(parameters, state, sample);
}

/// Ticks of reading the counter twice.
std::uint32_t reading_ticks() {
  const std::uint32_t before = board::ticks_left;
  __asm__ volatile("" ::: "memory");
  return (before - board::ticks_left) & 0xFFFFFFU;
}

void print_cost(const char* name, const std::uint32_t* counts) {
  std::uint32_t all = 0, largest = 0;
  std::uint64_t instructions = 0;
  for (std::uint32_t k = 0; k < most_instructions; ++k) {
    all += counts[k];
    instructions += static_cast<std::uint64_t>(counts[k]) * k;
    if (counts[k] > 0) largest = k;
  }
  std::uint32_t median = 0;
  for (std::uint32_t below = counts[0]; 2U * below < all; below += counts[median]) ++median;
  board::print(name);
  board::print(" steps", all);
  board::print(name);
  board::print(" median", median);
  board::print(name);
  board::print(" mean", all > 0 ? static_cast<std::uint32_t>((instructions + all / 2) / all) : 0);
  board::print(name);
  board::print(" largest", largest);
}

}  // namespace

int main() {
  board::start_ticks();
  const std::uint32_t overhead = reading_ticks();
  const Run& run = run_begin;
  constexpr float millionth = 1e-6F * valve_model::rated_flow_m3_per_s;
  float largest_error_m3_per_s = 0.0F;
  std::uint32_t not_a_number = 0, statuses = 0, overflowing = 0;
  board::watch_floats();
  board::paint_stack();
  one_step(other_state, run_points[0].sample);
  board::print("stack_bytes", board::used_stack_bytes());
  for (std::uint32_t k = 0; k < run.points; ++k) {
    const Point& point = run_points[k];
    const std::uint32_t before = board::ticks_left;
    const spoolflow::sensor::Estimate<float>& estimate = one_step(state, point.sample);
    const std::uint32_t ticks = ((before - board::ticks_left) & 0xFFFFFFU) - overhead;
    const std::uint32_t count = board::instructions(ticks);
    if (count >= most_instructions) ++overflowing;
    ++histogram[mode_of(state, estimate)][count < most_instructions ? count : most_instructions - 1];
    statuses |= static_cast<std::uint32_t>(estimate.status);
    const float numbers[] = {estimate.flow_m3_per_s,       estimate.flow_lower_m3_per_s,
                             estimate.flow_upper_m3_per_s, estimate.pressure_difference_Pa,
                             estimate.magnetic_force_N,    estimate.spring_force_N,
                             estimate.flow_force_N,        estimate.friction_force_N};
    for (const float number : numbers) not_a_number += number == number ? 0U : 1U;
    const float error_m3_per_s = estimate.flow_m3_per_s - point.golden_m3_per_s;
    const float size_m3_per_s = error_m3_per_s < 0.0F ? -error_m3_per_s : error_m3_per_s;
    if (k < run.recorded && size_m3_per_s > largest_error_m3_per_s) largest_error_m3_per_s = size_m3_per_s;
    if (k + 1U == run.recorded) board::print("flags_recorded", board::float_flags() & 0xFFU);
  }
  board::print("flags", board::float_flags() & 0xFFU);
  board::print("points", run.points);
  board::print("not_a_number", not_a_number);
  board::print("statuses", statuses);
  board::print("overflowing", overflowing);
  board::print("error_ppm", static_cast<std::uint32_t>(largest_error_m3_per_s / millionth));
  board::print("state_bytes", sizeof(State));
  std::uint32_t* const all = histogram[0];
  char name[] = "mode0";
  for (std::uint32_t mode = 0; mode < modes; ++mode) {
    name[4] = static_cast<char>('0' + mode);
    print_cost(name, histogram[mode]);
    for (std::uint32_t k = 0; mode > 0 && k < most_instructions; ++k) all[k] += histogram[mode][k];
  }
  print_cost("all", all);
  return 0;
}

#include "spoolflow/monitor/event_finder.hpp"

#include <algorithm>

namespace spoolflow::monitor {

namespace {

void add(FinderMean& mean, const FinderMean& more) {
  mean.weight += more.weight;
  const double share = more.weight / mean.weight;
  mean.position_m += share * (more.position_m - mean.position_m);
  mean.net_force_N += share * (more.net_force_N - mean.net_force_N);
  mean.friction_N += share * (more.friction_N - mean.friction_N);
  mean.current_A += share * (more.current_A - mean.current_A);
  mean.oil_temperature_K += share * (more.oil_temperature_K - mean.oil_temperature_K);
  mean.pressure_difference_Pa += share * (more.pressure_difference_Pa - mean.pressure_difference_Pa);
}

ForceEvent event(const FinderMean& of, double time_s, double direction, EventKind kind) {
  return {.time_s = time_s,
          .position_m = of.position_m,
          .net_force_N = of.net_force_N,
          .rested_s = 0,
          .friction_N = of.friction_N,
          .current_A = of.current_A,
          .oil_temperature_K = of.oil_temperature_K,
          .pressure_difference_Pa = of.pressure_difference_Pa,
          .direction = direction,
          .count = 1,
          .kind = kind};
}

/// A stretch that travels less is noise [m].
constexpr double least_travel_m = 3e-6;

bool counts(double position_m, double stroke_m) {
  return position_m > lowest_event_share * stroke_m && position_m < highest_event_share * stroke_m;
}

/// The largest force in the direction of the break-away, of the blocks before the last.
double breakaway_force_N(const FinderState& state, double direction) {
  const std::size_t ring = state.force_N.size();
  const std::size_t count = std::min(state.blocks, force_blocks);
  double largest = -1e30;
  for (std::size_t back = 2; back <= count; ++back)
    largest = std::max(largest, direction * state.force_N[(state.newest + ring - back) % ring]);
  return direction * largest;
}

std::optional<ForceEvent> close_slide(FinderState& state, double stroke_m) {
  const FinderMean slide = state.slide;
  const double dithered = state.slide_dithered;
  state.slide = {};
  state.slide_dithered = 0;
  const double travel_m = state.last[0].position_m - state.slide_begin_m;
  const double time_s = state.still_s - state.slide_begin_s;
  if (slide.weight < sliding_blocks || !counts(slide.position_m, stroke_m) || slide.friction_N == 0) return {};
  if (std::abs(travel_m) > fastest_sliding_m_per_s * std::max(time_s, event_block_s)) return {};
  const double direction = slide.friction_N > 0 ? 1 : -1;  // the sensor knows it from more than this stretch
  if (direction * travel_m < least_travel_m) return {};
  if (dithered > 0 && dithered < slide.weight) return {};
  return event(slide, state.still_s, direction, dithered > 0 ? EventKind::dithered : EventKind::sliding);
}

/// The stretch of sliding goes on, or ends with this block.
void follow_slide(double stroke_m, FinderState& state, const FinderMean& block, bool slides, bool dithered,
                  double time_s, FoundEvents& out) {
  if (slides && std::abs(block.friction_N) > 0) {
    if (state.slide.weight == 0) {
      state.slide_begin_m = block.position_m;
      state.slide_begin_s = time_s;
    }
    add(state.slide, block);
    state.slide_dithered += dithered ? 1 : 0;
    if (std::abs(block.position_m - state.slide_begin_m) > sliding_travel_share * stroke_m)
      out.slide = close_slide(state, stroke_m);
  } else if (state.slide.weight > 0) {
    out.slide = close_slide(state, stroke_m);
  }
}

}  // namespace

void interrupt(FinderState& state) {
  state.resting = false;
  state.block = {};
  state.block_time_s = state.sliding_share = state.dithered_share = 0;
  state.blocks = 0;
  state.slide = {};
  state.slide_dithered = 0;
}

FoundEvents find_events(const sensor::ObserverParameters<double>& valve, double stroke_m, FinderState& state,
                        const FinderSample& sample) {
  FoundEvents out;
  add(state.block, {sample.position_m, sample.net_force_N, sample.friction_N, sample.current_A,
                    sample.oil_temperature_K, sample.pressure_difference_Pa, 1});
  state.block_time_s += sample.time_step_s;
  state.sliding_share += sample.sliding ? 1 : 0;
  state.dithered_share += sample.dithered ? 1 : 0;
  if (state.block_time_s < event_block_s - 0.5 * sample.time_step_s) return out;

  FinderMean block = state.block;
  const bool slides = state.sliding_share == block.weight;
  const bool dithered = state.dithered_share > 0;
  block.weight = 1;
  state.block = {};
  state.block_time_s = state.sliding_share = state.dithered_share = 0;
  state.newest = (state.newest + 1) % state.force_N.size();
  state.force_N[state.newest] = block.net_force_N;
  state.last = {block, state.last[0], state.last[1]};
  state.blocks = std::min(state.blocks + 1, state.force_N.size());

  const double threshold_m = std::max(breakaway_travel_m, breakaway_noises * valve.position_sensor.noise_m);
  const double from_m = block.position_m - state.rest_m;
  const bool jumps = std::abs(block.position_m - state.last[2].position_m) > breakaway_jump_share * threshold_m;
  const bool breaks =
      state.resting && std::abs(from_m) > threshold_m && (jumps || std::abs(from_m) > creep_travels * threshold_m);
  if (breaks) {
    const double rested_s = state.still_s - state.rest_since_s;
    if (!dithered && !slides && jumps && state.blocks > 3 && rested_s > shortest_event_rest_s &&
        rested_s < longest_event_rest_s && counts(state.rest_m, stroke_m)) {
      const double direction = from_m > 0 ? 1 : -1;
      ForceEvent found = event(state.last[2], sample.time_s, direction, EventKind::breakaway);
      found.position_m = state.rest_m;
      found.rested_s = rested_s;
      found.net_force_N = breakaway_force_N(state, direction);
      out.breakaway = found;
    }
  }
  if (breaks || !state.resting) {
    if (breaks || state.blocks >= state.force_N.size()) {
      // Where nothing was known before, neither is how long it has rested: longer than what counts.
      state.rest_since_s = breaks ? sample.time_s : sample.time_s - 2 * longest_event_rest_s;
      state.resting = true;
      state.rest_m = block.position_m;
      state.blocks = 1;
    }
  }
  state.still_s = sample.time_s;

  follow_slide(stroke_m, state, block, slides, dithered, sample.time_s, out);
  return out;
}

}  // namespace spoolflow::monitor

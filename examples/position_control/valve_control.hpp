#pragma once
/// A position controller for a whole 4/3 valve with the flow sensor in its loop: the machine's set position is obeyed
/// as far as the flow stays below what the machine can bear. docs/embedded.md walks through it.
#include "spoolflow/sensor/whole_valve/whole_dither_request.hpp"
#include "spoolflow/sensor/whole_valve/whole_valve.hpp"

namespace sensor = spoolflow::sensor;
using sensor::Status;

struct ControlSettings {
  float stroke_m = 2.4e-3F;  ///< to either side
  float off_below_m = 2e-6F;
  float ramp_m_per_s = 0.04F;   ///< of the set position: faster than this the spool is not sent
  float feed_forward_A = 0.5F;  ///< lifts the springs' preload
  float feed_forward_A_per_m = 300;
  float proportional_A_per_m = 300;
  float integral_A_per_m_s = 8000;
  float integral_limit_A = 1.5F;
  float largest_current_A = 2.6F;

  float most_flow_m3_per_s = 5.5e-4F;  ///< that the machine can bear: 33 L/min
  float limit_per_s = 40;              ///< m/s of opening for each m3/s above or below it
  float limit_lead_m = 0.1e-3F;        ///< so far the limit goes ahead of the spool: it is near when it is needed
  float cautious_m = 0.9e-3F;          ///< the most opening while the flow is not known
  float longest_doubt_s = 0.05F;       ///< that the flow limit waits for a fault to pass
  float longest_hold_s = 0.02F;        ///< that the currents stay where the position is missing
  sensor::DitherRequestParameters<float> dither_request{2e-5F, 0.26F, 0.39F, 125, 0.5F, 0};
};

/// What of the sensor's answer the controller goes by.
enum class Trust : std::uint32_t { flow = 0, position_alone = 1, feed_forward_alone = 2, nothing = 3 };

/// Faults of the inputs, the gravest first. Limits are no reason not to trust: the band has them in it.
inline Trust trust_in(Status status) {
  if (has(status, Status::sample_missing | Status::time_fault)) return Trust::nothing;
  if (has(status, Status::position_fault)) return Trust::feed_forward_alone;
  const bool faulty = (static_cast<std::uint32_t>(status) & sensor::fault_bits) != 0;
  return faulty ? Trust::position_alone : Trust::flow;
}

struct ControlState {
  sensor::WholeValveState<float> sensor{};
  sensor::DitherRequestState<float> dither_request{};
  float integral_A = 0;
  float set_A = 0;  ///< > 0: solenoid b
  float set_m = 0;  ///< on its way to what is asked for
  float limit_m = 0.9e-3F;
  float doubted_s = 0;  ///< for how long the flow has not been known
  float missing_s = 0;  ///< for how long the position has not
  float unseen_s = 0;   ///< for how long there have been no parameters to step with
};

struct Orders {
  float set_A = 0;  ///< > 0: solenoid b, < 0: solenoid a
  sensor::DitherRequest<float> dither{};
  Trust trust = Trust::nothing;
};

/// How far the valve may open. The far end of the band is held below what the machine can bear: a sensor that is less
/// sure opens less, and one that is not to be trusted opens no further than is right at any pressure.
inline float allowed_opening_m(const ControlSettings& set, ControlState& state, const sensor::Estimate<float>& answer,
                               Trust trust, float time_step_s) {
  state.doubted_s = trust == Trust::flow ? 0 : state.doubted_s + time_step_s;
  if (trust == Trust::flow) {
    const float may_flow_m3_per_s = sensor::larger(answer.flow_upper_m3_per_s, -answer.flow_lower_m3_per_s);
    state.limit_m += set.limit_per_s * (set.most_flow_m3_per_s - may_flow_m3_per_s) * time_step_s;
    const float ahead_m = sensor::magnitude(state.set_m) + set.limit_lead_m;
    state.limit_m = sensor::limited(state.limit_m, 0.1F * set.stroke_m, sensor::smaller(ahead_m, set.stroke_m));
  } else if (state.doubted_s > set.longest_doubt_s) {
    state.limit_m = sensor::smaller(state.limit_m, set.cautious_m);
  }
  return state.limit_m;
}

/// Feed-forward and PI, whose sign chooses the solenoid.
inline float position_control(const ControlSettings& set, ControlState& state, float set_m, float position_m,
                              Trust trust, float time_step_s) {
  if (trust == Trust::nothing) {  // the spool is where it was, or nobody knows where: then the springs centre it
    state.missing_s += time_step_s;
    return state.missing_s > set.longest_hold_s ? 0 : state.set_A;
  }
  state.missing_s = 0;
  if (sensor::magnitude(set_m) <= set.off_below_m) return 0;
  const float feed_forward_A =
      (set_m > 0 ? set.feed_forward_A : -set.feed_forward_A) + set.feed_forward_A_per_m * set_m;
  if (trust == Trust::feed_forward_alone) return feed_forward_A + state.integral_A;
  const float error_m = set_m - position_m;
  state.integral_A = sensor::limited(state.integral_A + set.integral_A_per_m_s * error_m * time_step_s,
                                     -set.integral_limit_A, set.integral_limit_A);
  return feed_forward_A + set.proportional_A_per_m * error_m + state.integral_A;
}

/// One sample. `valve`: the parameters at work; null where there are none: the valve then works without its sensor.
inline Orders control(const ControlSettings& set, ControlState& state, const sensor::WholeValveParameters<float>* valve,
                      sensor::WholeValveSample<float> sample, float set_position_m) {
  Orders orders;
  const float time_step_s = sample.time_step_s;
  if (valve != nullptr) {
    const bool unseen = state.unseen_s > 0;
    sample.time_step_s += state.unseen_s;  // the sensor's own time: after more than a second it is reset
    state.unseen_s = 0;
    const Status status = step(*valve, state.sensor, sample).status;
    orders.trust = trust_in(unseen ? without(status, Status::time_fault) : status);  // the gap is of its own making
    orders.dither = request_dither(set.dither_request, state.dither_request, *valve, state.sensor, sample.time_step_s);
  } else {
    state.unseen_s += time_step_s;
    orders.trust = sensor::is_number(sample.position_m) ? Trust::position_alone : Trust::nothing;
  }
  const float most_m = allowed_opening_m(set, state, state.sensor.open.last, orders.trust, time_step_s);
  const float step_m = set.ramp_m_per_s * time_step_s;
  const float asked_m = sensor::limited(set_position_m, -most_m, most_m);
  const float set_m = sensor::limited(asked_m, state.set_m - step_m, state.set_m + step_m);
  if (set_m * state.set_m <= 0) state.integral_A = 0;  // through the centre
  state.set_m = set_m;
  const float set_A = position_control(set, state, set_m, sample.position_m, orders.trust, time_step_s);
  state.set_A = sensor::limited(set_A, -set.largest_current_A, set.largest_current_A);
  orders.set_A = state.set_A;
  return orders;
}

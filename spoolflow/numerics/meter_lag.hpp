#pragma once
/// What a meter does to what it measures: it shows it late, and smoothed.
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

namespace spoolflow::numerics {

/// A flow meter: dead time, then a first-order lag.
struct MeterLag {
  double dead_time_s = 0;
  double lag_s = 0;
};

/// How much of a change that holds for a step a first-order lag, > 0, shows at the step's end.
inline double lag_share(double step_s, double lag_s) {
  return -std::expm1(-step_s / lag_s);
}

/// The same, step after step: an exponential is asked for where the step changes. All of it where there is no lag.
class LagShare {
 public:
  explicit LagShare(double lag_s) : lag_s_(lag_s) {}
  double operator()(double step_s) {
    if (!(lag_s_ > 0)) return 1;
    constexpr double same_step = 1e-9;  // as a share of it: the difference of two times is rounded
    if (!(std::abs(step_s - step_s_) <= same_step * step_s_)) {  // nor of no number
      step_s_ = step_s;
      share_ = lag_share(step_s, lag_s_);
    }
    return share_;
  }

 private:
  double lag_s_;
  double step_s_ = 0, share_ = 0;
};

/// What such a meter shows of `values`, in place: exactly, for values that hold between samples. Before the dead time
/// is over it shows the first value; a NaN is no value, and the meter shows what it showed before.
template <class Number>
void apply_lag(std::span<const double> time_s, std::span<Number> values, const MeterLag& meter) {
  if (meter.dead_time_s > 0) {
    std::size_t seen = values.size();
    for (std::size_t k = values.size(); k-- > 0;) {
      while (seen > 0 && (seen > k || time_s[seen] > time_s[k] - meter.dead_time_s)) --seen;
      values[k] = values[seen];
    }
  }
  if (!(meter.lag_s > 0)) return;
  LagShare share_of(meter.lag_s);
  for (std::size_t k = 1; k < values.size(); ++k) {
    const double share = share_of(time_s[k] - time_s[k - 1]);
    const double change = values[k] - values[k - 1];
    values[k] = static_cast<Number>(std::isnan(change) ? values[k - 1] : values[k - 1] + share * change);
  }
}

/// The meter that shows `reference` where the flow was `flow`, from samples at the same times. What it is judged by are
/// changes over a tenth of a second, by their size: an offset, slow errors and a few large ones say nothing of a lag.
/// Dead time and lag up to 0.5 s. Nothing where fewer than `least_samples` samples have both, the flow never
/// changes, or a quarter of the reference's changes stays unexplained: such a lag would hide the flow's own errors.
std::optional<MeterLag> find_meter_lag(std::span<const double> time_s, std::span<const double> flow,
                                       std::span<const double> reference, std::size_t least_samples = 1000);

/// The same where `flow` is known, as from a metering edge and the measured pressure difference over it. It is judged
/// by its levels, a gain and an offset taken out: so slow strokes beside a noisy meter show the lag, too.
std::optional<MeterLag> find_lag_of_known_flow(std::span<const double> time_s, std::span<const double> flow,
                                               std::span<const double> reference, std::size_t least_samples = 1000);

}  // namespace spoolflow::numerics

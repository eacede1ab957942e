#include "spoolflow/calibration/references/passed_oil.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/calibration/operation/replay.hpp"
#include "spoolflow/numerics/median.hpp"
#include "spoolflow/recording/channels/recording_error.hpp"
#include "spoolflow/sensor/observer.hpp"
#include "spoolflow/units/conversion.hpp"

namespace spoolflow::calibration {

namespace {

/// For how long the pressure difference must have fallen so far [s].
constexpr double stays_fallen_s = 0.05;

/// The sensor's answers to a recording.
struct SeenSample {
  double time_s, pressure_difference_Pa;
  bool open;
};

std::vector<SeenSample> seen_samples(const sensor::ObserverParameters<double>& valve, double rated_flow_m3_per_s,
                                     const recording::Recording& recording) {
  std::vector<SeenSample> out;
  estimation::RunningSensor sensor(&valve, rated_flow_m3_per_s);
  const estimation::Columns columns = operating_columns(recording);
  estimation::run(sensor, columns, [&](std::size_t k, const sensor::Estimate<double>& answer) {
    const bool shut = sensor::has(answer.status, sensor::Status::closed) ||
                      sensor::has(answer.status, sensor::Status::other_direction);
    out.push_back({columns.time_s[k], answer.pressure_difference_Pa, !shut});
  });
  return out;
}

std::vector<double> while_open_Pa(const std::vector<SeenSample>& samples) {
  std::vector<double> out;
  for (const SeenSample& each : samples)
    if (each.open) out.push_back(each.pressure_difference_Pa);
  return out;
}

}  // namespace

double fallen_Pa(std::vector<double> pressure_difference_Pa) {
  constexpr double fallen_share = 0.15, most_samples = 0.9;
  std::erase_if(pressure_difference_Pa, [](double value) { return !std::isfinite(value); });
  if (pressure_difference_Pa.empty()) return 0;
  return fallen_share * numerics::quantile(std::move(pressure_difference_Pa), most_samples);
}

std::vector<recording::TimeMark> stalled_strokes(const sensor::ObserverParameters<double>& valve,
                                                 double rated_flow_m3_per_s, const recording::Recording& recording) {
  const std::vector<SeenSample> samples = seen_samples(valve, rated_flow_m3_per_s, recording);
  const double least_Pa = fallen_Pa(while_open_Pa(samples));
  std::vector<recording::TimeMark> out;
  bool from_the_end = false, stands = false;  // of the stroke before; now
  double left_s = NAN, fell_s = NAN;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const SeenSample &before = samples[k - 1], &now = samples[k];
    if (now.open && !before.open) {
      left_s = before.time_s;
      stands = false;
      fell_s = NAN;
    }
    if (!now.open && before.open) from_the_end = stands;
    if (!now.open || stands || std::isnan(left_s)) continue;
    if (now.pressure_difference_Pa >= least_Pa) {
      fell_s = NAN;
      continue;
    }
    if (std::isnan(fell_s)) fell_s = now.time_s;
    stands = now.time_s - fell_s >= stays_fallen_s;
    if (stands && from_the_end) out.push_back({left_s, fell_s, NAN});
  }
  return out;
}

namespace {

using recording::Channel;
using recording::EndsSeen;
using recording::RecordingError;
using recording::Reference;
using recording::ReferenceKind;
using recording::TimeMark;

/// A shorter stroke is none: ends are seen to some hundredths of a second.
constexpr double shortest_stroke_s = 0.3;
/// One standard deviation of the time at which an end, or a meter's lag, is known [s].
constexpr double end_time_uncertainty_s = 0.01, meter_lag_s = 0.03;
/// Flow of a meter below which an interval says little [share of the rated flow].
constexpr double least_metered_share = 0.01;

void require_channel(const Reference& reference, const recording::Recording& recording, Channel channel,
                     const char* why) {
  if (recording.has(channel)) return;
  throw RecordingError(fmt::format("{}: {} needs the channel {} of {}, {}; record it, or name it in a channel map",
                                   reference.place, reference.name, recording::name(channel),
                                   recording.file.filename().string(), why));
}

/// Whether the piston stands at each sample.
std::vector<bool> stands(const Reference& reference, const recording::Recording& recording) {
  std::vector<bool> out;
  if (reference.ends == EndsSeen::by_switch) {
    require_channel(reference, recording, Channel::test, "whose value is not zero while the piston stands");
    for (const double value : recording[Channel::test]) out.push_back(value != 0);
    return out;
  }
  require_channel(reference, recording, Channel::pressure_difference, "which falls while the piston stands");
  const auto pressure_Pa = recording[Channel::pressure_difference];
  const double below_Pa = fallen_Pa({pressure_Pa.begin(), pressure_Pa.end()});
  for (const double value : pressure_Pa) out.push_back(!(value >= below_Pa));
  return out;
}

/// From when the piston leaves an end to when it stands at the other. Motion at the recording's begin or end is part of
/// a stroke, and left out.
std::vector<TimeMark> strokes_seen(const Reference& reference, const recording::Recording& recording) {
  const std::vector<bool> standing = stands(reference, recording);
  const auto time_s = recording[Channel::time];
  std::vector<TimeMark> out;
  double left_s = NAN;
  for (std::size_t k = 1; k < standing.size(); ++k) {
    if (standing[k - 1] && !standing[k]) left_s = time_s[k];
    if (standing[k - 1] || !standing[k]) continue;
    out.push_back({left_s, time_s[k], NAN});
    left_s = NAN;
  }
  return out;
}

std::vector<TimeMark> marks_within(const Reference& reference, const recording::Recording& recording) {
  const double begin_s = recording[Channel::time].front(), end_s = recording[Channel::time].back();
  for (const TimeMark& mark : reference.marks) {
    if (mark.begin_s >= begin_s && mark.end_s <= end_s) continue;
    throw RecordingError(fmt::format(
        "{}: {}: the mark {} s to {} s lies outside {}, {} s to {} s; give times of the recording, or say "
        "with recording = \"FILE\" which one the marks are of",
        reference.place, reference.name, mark.begin_s, mark.end_s, recording.file.filename().string(), begin_s, end_s));
  }
  return reference.marks;
}

std::vector<TimeMark> intervals_of(const Reference& reference, const recording::Recording& recording,
                                   const sensor::ObserverParameters<double>& valve, double rated_flow_m3_per_s) {
  const bool stroke = reference.kind == ReferenceKind::stroke;
  if (stroke && reference.ends != EndsSeen::marks) {
    std::vector<TimeMark> out = reference.ends == EndsSeen::stalled
                                    ? stalled_strokes(valve, rated_flow_m3_per_s, recording)
                                    : strokes_seen(reference, recording);
    std::erase_if(out, [](const TimeMark& mark) { return !(mark.end_s - mark.begin_s > shortest_stroke_s); });
    return out;
  }
  if (reference.kind != ReferenceKind::meter) return marks_within(reference, recording);
  const double begin_s = recording[Channel::time].front(), end_s = recording[Channel::time].back();
  std::vector<TimeMark> out;
  for (double at_s = begin_s; at_s + reference.interval_s <= end_s; at_s += reference.interval_s)
    out.push_back({at_s, at_s + reference.interval_s, NAN});
  return out;
}

/// What a meter showed; NaN where samples are missing.
double metered_m3(const recording::Recording& recording, const TimeMark& mark) {
  const auto time_s = recording[Channel::time], flow = recording[Channel::flow_reference];
  double sum = 0;
  for (std::size_t k = 1; k < time_s.size(); ++k) {
    if (time_s[k - 1] >= mark.begin_s && time_s[k] <= mark.end_s) sum += flow[k] * (time_s[k] - time_s[k - 1]);
  }
  return sum;
}

PassedOil passed_in(const Reference& reference, std::size_t number, const recording::Recording& recording,
                    const TimeMark& mark) {
  const double lasts_s = mark.end_s - mark.begin_s;
  PassedOil out{number, mark.begin_s, mark.end_s, 0, 0};
  if (reference.kind == ReferenceKind::stroke) {
    out.volume_m3 = reference.area_m2 * reference.length_m + 0.5 * reference.compression_m3;
    const double compression_m3 = reference.compression_m3 / std::sqrt(12.0);  // any share of it is as likely
    out.uncertainty_m3 = std::hypot(0.5 * reference.length_uncertainty_m * reference.area_m2, compression_m3,
                                    out.volume_m3 / lasts_s * end_time_uncertainty_s);
  } else if (reference.kind == ReferenceKind::pump) {
    const double speed = std::isnan(mark.speed_rad_per_s) ? reference.speed_rad_per_s : mark.speed_rad_per_s;
    out.volume_m3 = (reference.displacement_m3_per_rad * speed - reference.leakage_m3_per_s) * lasts_s;
    out.uncertainty_m3 = std::abs(out.volume_m3) / lasts_s * end_time_uncertainty_s;
  } else {
    out.volume_m3 = metered_m3(recording, mark);
    out.uncertainty_m3 = std::abs(out.volume_m3) / lasts_s * meter_lag_s;
  }
  return out;
}

/// Why a reference shows no oil, and what to do about it.
std::string why_unseen(const Reference& reference, const recording::Recording& recording, double least_m3_per_s) {
  if (reference.kind != ReferenceKind::meter) {
    return "no interval of it lies there whole, with oil that passed; check its figures and how its ends are seen, or "
           "mark them in a file with ends = \"marks\"";
  }
  const double lasts_s = recording[Channel::time].back() - recording[Channel::time].front();
  if (lasts_s < reference.interval_s) {
    return fmt::format("it lasts {:.4g} s, and interval_s is {:g}; give a longer recording, or a shorter interval_s",
                       lasts_s, reference.interval_s);
  }
  double lowest = INFINITY, highest = -INFINITY;
  for (const double flow : recording[Channel::flow_reference]) {
    lowest = std::fmin(lowest, flow);
    highest = std::fmax(highest, flow);
  }
  const std::string values = lowest > highest
                                 ? "has no values"
                                 : fmt::format("is {:.3g} to {:.3g} L/min", units::L_per_min_from_m3_per_s(lowest),
                                               units::L_per_min_from_m3_per_s(highest));
  return fmt::format(
      "flow_reference {}, and no interval of {:g} s without missing values has {:.2g} L/min or more on average; look "
      "at "
      "the meter's sign, unit and column",
      values, reference.interval_s, units::L_per_min_from_m3_per_s(least_m3_per_s));
}

}  // namespace

std::vector<PassedOil> passed_oil(const Reference& reference, std::size_t number, const recording::Recording& recording,
                                  const sensor::ObserverParameters<double>& valve, double rated_flow_m3_per_s) {
  const bool other = !reference.recording.empty() && reference.recording != recording.file.filename().string();
  if (other || reference.kind == ReferenceKind::closed) return {};
  if (reference.kind == ReferenceKind::meter)
    require_channel(reference, recording, Channel::flow_reference, "the meter's flow");
  const double least = reference.kind == ReferenceKind::meter ? least_metered_share * rated_flow_m3_per_s : 0;
  std::vector<PassedOil> out;
  for (const TimeMark& mark : intervals_of(reference, recording, valve, rated_flow_m3_per_s)) {
    const PassedOil oil = passed_in(reference, number, recording, mark);
    if (oil.volume_m3 > least * (mark.end_s - mark.begin_s)) out.push_back(oil);
  }
  if (!out.empty()) return out;
  throw RecordingError(fmt::format("{}: {} is not seen in {}: {}", reference.place, reference.name,
                                   recording.file.filename().string(), why_unseen(reference, recording, least)));
}

}  // namespace spoolflow::calibration

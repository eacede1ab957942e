#pragma once
/// What findings say, and a run as they are judged by it.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "spoolflow/plausibility/run_findings.hpp"

namespace spoolflow::plausibility {

inline std::string all_texts(const std::vector<Finding>& findings) {
  std::string out;
  for (const Finding& finding : findings) out += finding.text + "\n";
  return out;
}

/// The channel repeats one value for half of its recording, from that share of it on.
inline void freeze_half(std::vector<double>& values, double from) {
  const std::size_t begin = static_cast<std::size_t>(from * static_cast<double>(values.size()));
  const double value = values[begin];
  for (std::size_t k = begin; k < values.size() && k < begin + values.size() / 2; ++k) values[k] = value;
}

/// A channel comes so much later beside the others of a run at even time steps; what lacks then repeats its end.
inline void shift_by(recording::Recording& run, double late_s,
                     recording::Channel channel = recording::Channel::flow_reference) {
  const std::vector<double>& time_s = run.column(recording::Channel::time);
  const auto last = static_cast<std::ptrdiff_t>(run.size()) - 1;
  const std::ptrdiff_t rows = std::lround(late_s / (time_s[1] - time_s[0]));
  std::vector<double>& shifted = run.column(channel);
  const std::vector<double> sound = shifted;
  for (std::ptrdiff_t k = 0; k <= last; ++k)
    shifted[static_cast<std::size_t>(k)] =
        sound[static_cast<std::size_t>(std::clamp(k - rows, std::ptrdiff_t{0}, last))];
}

/// The run, and behind it the same to the other side of a whole valve whose sides are alike.
inline recording::Recording both_sides(const recording::Recording& run) {
  recording::Recording out{run.file, {}};
  const double duration_s =
      2 * run.column(recording::Channel::time).back() - run.column(recording::Channel::time).end()[-2];
  for (const int side : {1, -1}) {
    for (std::size_t k = 0; k < run.size(); ++k) {
      out.column(recording::Channel::time)
          .push_back(run.column(recording::Channel::time)[k] + (side > 0 ? 0 : duration_s));
      out.column(recording::Channel::position).push_back(side * run.column(recording::Channel::position)[k]);
      out.column(recording::Channel::flow_reference)
          .push_back(side * run.column(recording::Channel::flow_reference)[k]);
      out.column(recording::Channel::pressure_difference)
          .push_back(run.column(recording::Channel::pressure_difference)[k]);
      out.column(recording::Channel::current_b).push_back(side > 0 ? run.column(recording::Channel::current)[k] : 0);
      out.column(recording::Channel::current_a).push_back(side < 0 ? run.column(recording::Channel::current)[k] : 0);
    }
  }
  return out;
}

inline RunMeans means_of(const recording::Recording& run) {
  RunMeans out;
  out.take({run.columns, run.size()});
  return out;
}

}  // namespace spoolflow::plausibility

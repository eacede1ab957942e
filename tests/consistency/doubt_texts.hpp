#pragma once
/// What doubts say, and a run as doubts are judged by it.
#include <cstddef>
#include <string>
#include <vector>

#include "spoolflow/consistency/run_doubts.hpp"

namespace spoolflow::consistency {

inline std::string all_texts(const std::vector<Doubt>& doubts) {
  std::string out;
  for (const Doubt& doubt : doubts) out += doubt.text + "\n";
  return out;
}

/// The channel repeats one value for half of its recording, from that share of it on.
inline void freeze_half(std::vector<double>& values, double from) {
  const std::size_t begin = static_cast<std::size_t>(from * static_cast<double>(values.size()));
  const double value = values[begin];
  for (std::size_t k = begin; k < values.size() && k < begin + values.size() / 2; ++k) values[k] = value;
}

inline RunMeans means_of(const recording::Recording& run) {
  RunMeans out;
  out.take({run.columns, run.size()});
  return out;
}

}  // namespace spoolflow::consistency

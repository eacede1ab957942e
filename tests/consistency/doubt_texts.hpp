#pragma once
/// What doubts say, and a run as doubts are judged by it.
#include <string>
#include <vector>

#include "spoolflow/consistency/run_doubts.hpp"

namespace spoolflow::consistency {

inline std::string all_texts(const std::vector<Doubt>& doubts) {
  std::string out;
  for (const Doubt& doubt : doubts) out += doubt.text + "\n";
  return out;
}

inline RunMeans means_of(const recording::Recording& run) {
  RunMeans out;
  out.take({run.columns, run.size()});
  return out;
}

}  // namespace spoolflow::consistency

#pragma once
/// How far a monitored valve's watch has come, as one piece tells it to the next, bit for bit.
#include <string>
#include <vector>

#include "spoolflow/monitor/watch.hpp"
#include "spoolflow/report/monitor/monitored_run.hpp"

namespace spoolflow::apps {

struct Watched {
  monitor::WatchState state{};
  std::vector<report::TrendPoint> trend{};
  report::DoubtFigures band{};
};

/// Bytes for programs of this version on machines of this kind.
[[nodiscard]] std::string bytes_of(const Watched& watched);
/// Throws fleet::PieceError.
[[nodiscard]] Watched read_watched(const std::string& bytes);

}  // namespace spoolflow::apps

#pragma once
/// The several times that one file's columns may be of, for `inspect`.
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "spoolflow/recording/channel_map.hpp"
#include "spoolflow/recording/files/sample_table.hpp"

namespace spoolflow::recording {

struct InspectedClock {
  std::string time;  ///< its column; empty: evenly sampled, as attributes say
  std::uint64_t samples = 0;
  double rate_Hz = 0;  ///< 1 / median time step, 0 of fewer than two
  double begin_s = 0, end_s = 0;
  std::vector<std::string> columns;  ///< in the file's order
  bool leads = false;                ///< of the current, onto whose time the others are brought
  std::string fault{};               ///< why it cannot be used; empty where it can
};

/// Takes the time of the proposal's current (else of its position) instead of another that the file holds. Whether
/// there is none because the file says that it is sampled evenly; where neither is proposed, whether it says so of
/// anything.
bool propose_leading_time(ChannelMap& proposal, const SampleTable& table, const std::string& file);

/// The clocks of all columns in the file's order; none where all columns are of one, or for tables of rows.
[[nodiscard]] std::vector<InspectedClock> inspected_clocks(const ChannelMap& proposal,
                                                           const std::function<std::unique_ptr<SampleTable>()>& open,
                                                           const std::string& file);

}  // namespace spoolflow::recording

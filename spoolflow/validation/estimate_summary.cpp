#include "spoolflow/validation/estimate_summary.hpp"

#include <algorithm>
#include <bit>

#include <fmt/format.h>

namespace spoolflow::validation {

void EstimateSummary::add(std::span<const sensor::Estimate<double>> estimates) {
  samples += estimates.size();
  std::array<std::uint64_t, 32> with_bit{};
  for (const sensor::Estimate<double>& estimate : estimates) {
    flow_sum_m3_per_s += estimate.flow_m3_per_s;
    width_sum_m3_per_s += estimate.flow_upper_m3_per_s - estimate.flow_lower_m3_per_s;
    const auto bits = static_cast<std::uint32_t>(estimate.status);
    with_fault += (bits & sensor::fault_bits) != 0;
    for (std::uint32_t left = bits; left != 0; left &= left - 1)
      ++with_bit[static_cast<std::size_t>(std::countr_zero(left))];
  }
  for (std::size_t k = 0; k < with_status.size(); ++k) {
    const auto bit = static_cast<std::uint32_t>(sensor::status_names[k].bit);
    with_status[k] += with_bit[static_cast<std::size_t>(std::countr_zero(bit))];
  }
}

std::string EstimateSummary::sentence(double rated_flow_m3_per_s) const {
  if (samples == 0) return fmt::format("{}: no samples", file);
  const auto count = static_cast<double>(samples);
  std::string out = fmt::format("{}: {} samples, band {:.1f} % of the rated flow wide on average", file, samples,
                                100 * width_sum_m3_per_s / count / rated_flow_m3_per_s);
  std::vector<std::size_t> order;
  for (std::size_t k = 0; k < with_status.size(); ++k) {
    if (with_status[k] > 0) order.push_back(k);
  }
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::size_t k) { return with_status[k]; });
  for (std::size_t k = 0; k < order.size(); ++k) {
    out += fmt::format("{}{} {:.1f} %", k == 0 ? "; " : ", ", sensor::status_names[order[k]].name,
                       100 * static_cast<double>(with_status[order[k]]) / count);
  }
  return out;
}

}  // namespace spoolflow::validation

#include "spoolflow/validation/status_timeline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace spoolflow::validation {
namespace {

/// Shares are shown in quarters, rounded up: the rarest status still shows.
double in_quarters(std::size_t having, std::size_t samples) {
  return std::ceil(4.0 * static_cast<double>(having) / static_cast<double>(samples)) / 4;
}

std::vector<StatusSpan> spans_of(std::span<const double> time_s, std::span<const sensor::Status> status,
                                 sensor::Status bit, double stretch_s) {
  std::vector<StatusSpan> out;
  std::size_t begin = 0;
  for (std::size_t k = 1; k <= time_s.size(); ++k) {
    if (k < time_s.size() && time_s[k] - time_s[begin] < stretch_s) continue;
    std::size_t having = 0;
    for (std::size_t j = begin; j < k; ++j) having += sensor::has(status[j], bit) ? 1 : 0;
    const double until_s = k < time_s.size() ? std::min(time_s[k], time_s[k - 1] + stretch_s) : time_s[k - 1];
    const double share = in_quarters(having, k - begin);
    if (share > 0 && !out.empty() && out.back().share == share && out.back().to_s >= time_s[begin]) {
      out.back().to_s = until_s;
    } else if (share > 0) {
      out.push_back({time_s[begin], until_s, share});
    }
    begin = k;
  }
  return out;
}

struct Meaning {
  sensor::Status bit;
  const char* text;
};

constexpr std::array meanings = [] {
  using enum sensor::Status;
  return std::to_array<Meaning>({
      {closed, "The spool covers the metering edge: no flow but leakage."},
      {spool_at_rest, "The spool rests: friction lies anywhere within its limits, and the band is as wide as that."},
      {outside_force_map,
       "Current or position left the magnetic-force map; answered at its edge. Calibrate over more of them."},
      {outside_flow_force_map, "The flow force left what was measured at this position; answered at the map's edge."},
      {outside_temperature, "The oil is colder or warmer than in the calibration's recordings."},
      {current_saturated, "The current sits at the end of its range: the force may be larger than it shows."},
      {dithered,
       "The current is dithered: friction swings between its limits, and the extremes of each period bound it."},
      {sign_undetermined, "The spool stands so near the centre that the oil may flow either way."},
      {ambiguous_load, "More flow force than the supply explains: a load may drive the oil, and the flow be larger."},
      {flow_reversed, "By the pressures at the ports a load drives the oil against the way that the spool opens."},
      {open_stop,
       "The spool stands on its open stop, which may hold what flow force does not: the flow may be smaller."},
      {position_fault,
       "The position signal moved as no spool can, and the last credible position was used; or it stayed closed "
       "against forces that move any spool. Look at its wiring."},
      {sample_missing, "An input was missing; the last flow was held, and its band opened."},
      {time_fault,
       "The time stood still, ran backwards (the last answer was held), or went on by 9 ms or more, for which the "
       "sensor is not made. Look at the time stamps, and sample at 1 kHz."},
      {other_direction,
       "The spool opens the direction of flow of which the model knows nothing: the band is all that may flow there. "
       "Calibrate the whole valve, or look at the sign of the position."},
      {current_fault, "The current leapt as no coil lets it; the last credible one is used."},
      {temperature_fault,
       "The oil temperature read what no oil has, or leapt; the one before was held. Look at its sensor and line."},
      {model_doubt, "Indicators of the valve's condition contradict the model; the band is wider by what they say."},
      {coil_fault,
       "Voltage and current give a coil resistance that no sound coil has, or one of them is far beyond the "
       "calibration's; look for shorted turns, a bad contact, a broken amplifier or line, or a wrong unit."},
  });
}();

}  // namespace

const char* meaning(sensor::Status bit) {
  const auto found = std::ranges::find(meanings, bit, &Meaning::bit);
  return found == meanings.end() ? "" : found->text;
}

std::vector<StatusRow> status_rows(std::span<const double> time_s, std::span<const sensor::Status> status,
                                   std::size_t stretches) {
  std::vector<StatusRow> out;
  if (time_s.empty()) return out;
  const double stretch_s = (time_s.back() - time_s.front()) / static_cast<double>(stretches);
  for (unsigned place = 0; place < sensor::status_names.size(); ++place) {
    const sensor::StatusName& entry = sensor::status_names[place];
    const auto having =
        std::ranges::count_if(status, [&](sensor::Status each) { return sensor::has(each, entry.bit); });
    if (having == 0) continue;
    out.push_back({entry.name, meaning(entry.bit), (static_cast<std::uint32_t>(entry.bit) & sensor::fault_bits) != 0,
                   static_cast<double>(having) / static_cast<double>(time_s.size()),
                   spans_of(time_s, status, entry.bit, stretch_s), place});
  }
  std::ranges::stable_sort(out, [](const StatusRow& a, const StatusRow& b) { return a.share > b.share; });
  return out;
}

}  // namespace spoolflow::validation

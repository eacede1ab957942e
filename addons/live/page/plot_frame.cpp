#include "addons/live/page/plot_frame.hpp"

#include <bit>
#include <cstring>

#include "spoolflow/units/conversion.hpp"

namespace spoolflow::live {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in memory");

template <class N>
void put(std::vector<std::uint8_t>& out, N value) {
  const std::size_t at = out.size();
  out.resize(at + sizeof value);
  std::memcpy(out.data() + at, &value, sizeof value);
}

}  // namespace

std::vector<std::uint8_t> plot_frame(const ValveAtWork::TracePart& part, std::int64_t now_ns) {
  constexpr auto per_m3_per_s = static_cast<float>(units::litre_per_minute_per_m3_per_s);
  std::vector<std::uint8_t> out;
  out.reserve(plot_frame_header_bytes + plot_frame_point_bytes * part.points.size());
  put(out, std::uint32_t{1});
  put(out, static_cast<std::uint32_t>(part.points.size()));
  put(out, part.first);
  put(out, part.arrived_ns);
  put(out, now_ns);
  for (const PlotPoint& point : part.points) {
    put(out, point.time_s);
    put(out, point.flow_min_m3_per_s * per_m3_per_s);
    put(out, point.flow_max_m3_per_s * per_m3_per_s);
    put(out, point.lower_min_m3_per_s * per_m3_per_s);
    put(out, point.upper_max_m3_per_s * per_m3_per_s);
    put(out, point.position_m * 1e3F);
    put(out, point.current_A);
    put(out, point.status);
    put(out, std::uint32_t{0});
  }
  return out;
}

}  // namespace spoolflow::live

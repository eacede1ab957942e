#include "addons/fleet/pieces/watch_text.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <set>
#include <string_view>

#include <nlohmann/json.hpp>

#include "addons/fleet/jobs/piece.hpp"

namespace spoolflow::apps {
namespace {

using Json = nlohmann::json;

Json bits(double value) {
  return std::bit_cast<std::uint64_t>(value);  // JSON has no NaN
}

double number(const Json& json) {
  return std::bit_cast<double>(json.get<std::uint64_t>());
}

/// Names and units of indicators stay where they are for as long as the program runs.
std::string_view lasting(const Json& json) {
  static std::set<std::string> all;
  return *all.insert(json.get<std::string>()).first;
}

Json json_of(const monitor::Indicator& of) {
  return {std::string(of.name),
          bits(of.value),
          std::string(of.unit),
          bits(of.uncertainty_95),
          bits(of.baseline),
          of.state,
          of.trend.there,
          bits(of.trend.per_hour),
          bits(of.trend.uncertainty_95),
          bits(of.trend.limit),
          bits(of.trend.earliest_h),
          bits(of.trend.expected_h),
          bits(of.trend.latest_h)};
}

monitor::Indicator indicator_of(const Json& from) {
  monitor::Indicator out{.name = lasting(from.at(0)),
                         .value = number(from.at(1)),
                         .unit = lasting(from.at(2)),
                         .uncertainty_95 = number(from.at(3)),
                         .baseline = number(from.at(4)),
                         .state = from.at(5).get<monitor::IndicatorState>()};
  out.trend.there = from.at(6).get<bool>();
  double* const members[] = {&out.trend.per_hour,   &out.trend.uncertainty_95, &out.trend.limit,
                             &out.trend.earliest_h, &out.trend.expected_h,     &out.trend.latest_h};
  for (std::size_t k = 0; k < std::size(members); ++k) *members[k] = number(from.at(7 + k));
  return out;
}

}  // namespace

std::string bytes_of(const Watched& watched) {
  std::vector<std::uint8_t> state(sizeof(monitor::MonitorState));
  std::memcpy(state.data(), &watched.state, state.size());
  Json trend = Json::array();
  for (const report::TrendPoint& point : watched.trend) {
    Json indicators = Json::array();
    for (const monitor::Indicator& each : point.indicators) indicators.push_back(json_of(each));
    trend.push_back({bits(point.windows), std::move(indicators)});
  }
  const report::DoubtFigures& band = watched.band;
  const std::vector<std::uint8_t> out = Json::to_cbor(
      {{"state", Json::binary(std::move(state))},
       {"trend", std::move(trend)},
       {"band", {bits(band.samples), bits(band.doubted), bits(band.sensor_m3_per_s), bits(band.widened_m3_per_s)}}});
  return {out.begin(), out.end()};
}

Watched read_watched(const std::string& bytes) {
  try {
    const Json json = Json::from_cbor(bytes);
    Watched out;
    const Json::binary_t& state = json.at("state").get_binary();
    if (state.size() != sizeof out.state) throw fleet::PieceError("the state of a watch is of another version");
    std::memcpy(&out.state, state.data(), sizeof out.state);
    for (const Json& point : json.at("trend")) {
      out.trend.push_back({number(point.at(0)), {}});
      for (const Json& each : point.at(1)) out.trend.back().indicators.push_back(indicator_of(each));
    }
    const Json& band = json.at("band");
    out.band = {number(band.at(0)), number(band.at(1)), number(band.at(2)), number(band.at(3))};
    return out;
  } catch (const Json::exception&) {
    throw fleet::PieceError("the state of a watch is none that this program has written");
  }
}

}  // namespace spoolflow::apps

#pragma once
/// Sparkplug B 3.0 payloads: Protocol Buffers written by hand, as far as an edge node needs them. Metrics:
/// docs/fieldbus.md.
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "addons/live/protocols/plant_answer.hpp"

namespace spoolflow::fieldbus {

/// Data types 4, 7, 8, 10, 11 and 12 of Sparkplug: Int64, UInt32, UInt64, Double, Boolean, String.
using SparkplugValue = std::variant<std::int64_t, std::uint32_t, std::uint64_t, double, bool, std::string>;

struct SparkplugMetric {
  std::string name{};
  std::int64_t time_ms = 0;  ///< since 1970
  SparkplugValue value{};    ///< NaN is written as null
  bool is_historical = false;
  friend bool operator==(const SparkplugMetric&, const SparkplugMetric&) = default;
};

struct SparkplugPayload {
  std::int64_t time_ms = 0;
  int seq = 0;  ///< 0 to 255; < 0: none, as in NDEATH
  std::vector<SparkplugMetric> metrics{};
};
[[nodiscard]] std::string sparkplug_bytes(const SparkplugPayload& payload);

/// Whether an NCMD asks for a new birth: a metric "Node Control/Rebirth" that is true. Bytes that are no payload ask
/// for nothing.
[[nodiscard]] bool asks_for_rebirth(std::string_view payload);

/// A valve's metrics, in the same order each time.
[[nodiscard]] std::vector<SparkplugMetric> valve_metrics(const PlantAnswer& answer, std::int64_t time_ms);
/// Those of them that are others than before; `before` empty: all.
[[nodiscard]] std::vector<SparkplugMetric> changed_metrics(const std::vector<SparkplugMetric>& before,
                                                           const std::vector<SparkplugMetric>& now);

}  // namespace spoolflow::fieldbus

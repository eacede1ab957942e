#include "addons/live/protocols/sparkplug.hpp"

#include <array>
#include <bit>
#include <optional>

namespace spoolflow::fieldbus {
namespace {

enum class Wire : std::uint8_t { varint = 0, fixed64 = 1, bytes = 2, fixed32 = 5 };

void put_varint(std::string& out, std::uint64_t value) {
  for (; value >= 0x80U; value >>= 7U) out += static_cast<char>(value | 0x80U);
  out += static_cast<char>(value);
}
void put_key(std::string& out, unsigned field, Wire wire) {
  put_varint(out, field << 3U | static_cast<unsigned>(wire));
}
void put_number(std::string& out, unsigned field, std::uint64_t value) {
  put_key(out, field, Wire::varint);
  put_varint(out, value);
}
void put_bytes(std::string& out, unsigned field, std::string_view bytes) {
  put_key(out, field, Wire::bytes);
  put_varint(out, bytes.size());
  out += bytes;
}
void put_double(std::string& out, unsigned field, double value) {
  put_key(out, field, Wire::fixed64);
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (unsigned shift = 0; shift < 64; shift += 8) out += static_cast<char>(bits >> shift);
}

/// Field numbers of Payload.Metric.
namespace field {
constexpr unsigned name = 1, time = 3, type = 4, is_historical = 5, is_null = 7;
constexpr unsigned of_int = 10, of_long = 11, of_double = 13, of_bool = 14, of_text = 15;
}  // namespace field

struct ValueWriter {
  std::string& out;
  void operator()(std::int64_t value) const { put_number(out, field::of_long, static_cast<std::uint64_t>(value)); }
  void operator()(std::uint32_t value) const { put_number(out, field::of_int, value); }
  void operator()(std::uint64_t value) const { put_number(out, field::of_long, value); }
  void operator()(double value) const {
    if (std::isnan(value)) {
      put_number(out, field::is_null, 1);
    } else {
      put_double(out, field::of_double, value);
    }
  }
  void operator()(bool value) const { put_number(out, field::of_bool, value ? 1 : 0); }
  void operator()(const std::string& value) const { put_bytes(out, field::of_text, value); }
};

std::string metric_bytes(const SparkplugMetric& metric) {
  constexpr std::array<unsigned, 6> types{4, 7, 8, 10, 11, 12};  // in the order of SparkplugValue
  std::string out;
  put_bytes(out, field::name, metric.name);
  put_number(out, field::time, static_cast<std::uint64_t>(metric.time_ms));
  put_number(out, field::type, types.at(metric.value.index()));
  if (metric.is_historical) put_number(out, field::is_historical, 1);
  std::visit(ValueWriter{out}, metric.value);
  return out;
}

/// One field after the other; nothing at the end, or where the bytes break off.
class FieldReader {
 public:
  explicit FieldReader(std::string_view bytes) : rest_(bytes) {}
  struct Field {
    unsigned number = 0;
    std::uint64_t value = 0;
    std::string_view bytes{};
  };
  std::optional<Field> next() {
    const auto key = varint();
    if (!key) return std::nullopt;
    Field out{static_cast<unsigned>(*key >> 3U)};
    switch (static_cast<Wire>(*key & 7U)) {
      case Wire::varint: {
        const auto value = varint();
        if (!value) return std::nullopt;
        out.value = *value;
        return out;
      }
      case Wire::bytes: {
        const auto size = varint();
        if (!size || !take(*size, out.bytes)) return std::nullopt;
        return out;
      }
      case Wire::fixed64:
        return take(8, out.bytes) ? std::optional(out) : std::nullopt;
      case Wire::fixed32:
        return take(4, out.bytes) ? std::optional(out) : std::nullopt;
    }
    return std::nullopt;
  }

 private:
  bool take(std::uint64_t size, std::string_view& out) {
    if (size > rest_.size()) return false;
    out = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return true;
  }
  std::optional<std::uint64_t> varint() {
    std::uint64_t out = 0;
    for (unsigned shift = 0; shift < 64 && !rest_.empty(); shift += 7) {
      const auto byte = static_cast<unsigned char>(rest_.front());
      rest_.remove_prefix(1);
      out |= std::uint64_t{byte & 0x7FU} << shift;
      if ((byte & 0x80U) == 0) return out;
    }
    return std::nullopt;
  }
  std::string_view rest_;
};

}  // namespace

std::string sparkplug_bytes(const SparkplugPayload& payload) {
  std::string out;
  put_number(out, 1, static_cast<std::uint64_t>(payload.time_ms));
  for (const SparkplugMetric& metric : payload.metrics) put_bytes(out, 2, metric_bytes(metric));
  if (payload.seq >= 0) put_number(out, 3, static_cast<std::uint64_t>(payload.seq));
  return out;
}

bool asks_for_rebirth(std::string_view payload) {
  FieldReader fields(payload);
  while (const auto metric = fields.next()) {
    if (metric->number != 2) continue;
    FieldReader parts(metric->bytes);
    std::string_view name;
    bool value = false;
    while (const auto part = parts.next()) {
      if (part->number == field::name) name = part->bytes;
      if (part->number == field::of_bool) value = part->value != 0;
    }
    if (name == "Node Control/Rebirth" && value) return true;
  }
  return false;
}

std::vector<SparkplugMetric> valve_metrics(const PlantAnswer& answer, std::int64_t time_ms) {
  std::vector<SparkplugMetric> out;
  const auto put = [&](const char* name, SparkplugValue value) { out.push_back({name, time_ms, std::move(value)}); };
  put("Flow/L_min", answer.flow_m3_per_s * L_per_min_per_m3_per_s);
  put("Flow/lower_L_min", answer.flow_lower_m3_per_s * L_per_min_per_m3_per_s);
  put("Flow/upper_L_min", answer.flow_upper_m3_per_s * L_per_min_per_m3_per_s);
  put("Pressure difference/bar", answer.pressure_difference_Pa / pascal_per_bar);
  put("Rated flow/L_min", answer.rated_flow_m3_per_s * L_per_min_per_m3_per_s);
  put("Energy/J", answer.energy_J);
  put("Samples", answer.samples);
  put("Status", static_cast<std::uint32_t>(answer.status));
  put("NE 107", std::uint32_t{answer.ne107});
  put("Stalled", answer.stalled);
  return out;
}

std::vector<SparkplugMetric> changed_metrics(const std::vector<SparkplugMetric>& before,
                                             const std::vector<SparkplugMetric>& now) {
  if (before.size() != now.size()) return now;
  const auto is_nan = [](const SparkplugValue& value) {
    const auto* number = std::get_if<double>(&value);
    return number != nullptr && std::isnan(*number);
  };
  std::vector<SparkplugMetric> out;
  for (std::size_t k = 0; k < now.size(); ++k) {
    const bool same = now[k].value == before[k].value || (is_nan(now[k].value) && is_nan(before[k].value));
    if (!same) out.push_back(now[k]);
  }
  return out;
}

}  // namespace spoolflow::fieldbus

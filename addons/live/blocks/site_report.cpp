#include "addons/live/blocks/site_report.hpp"

#include <array>
#include <bit>
#include <string>

#include "spoolflow/numerics/little_endian.hpp"

namespace spoolflow::fleet {
namespace {

/// The same list of members writes and reads: `visit` is a Writer or a Reader.
template <class Visitor>
void each(Visitor& visit, live::Summary& of) {
  visit(of.samples);
  for (double* value : {&of.time_s, &of.flow_min_m3_per_s, &of.flow_mean_m3_per_s, &of.flow_max_m3_per_s,
                        &of.lower_min_m3_per_s, &of.upper_max_m3_per_s, &of.energy_J}) {
    visit(*value);
  }
  visit(of.status);
}

template <class Visitor>
void each(Visitor& visit, live::KeptIndicator& of) {
  visit(of.name);
  visit(of.value);
  visit(of.uncertainty_95);
  visit(of.baseline);
  visit(of.state);
  visit(of.unit);
}

template <class Visitor>
void each(Visitor& visit, live::Event& of) {
  visit(of.wall_ms);
  visit(of.time_s);
  visit(of.kind);
  visit(of.text);
}

template <class Visitor>
void each(Visitor& visit, live::Alarm& of) {
  visit(of.id);
  visit(of.cause);
  visit(of.sign);
  for (std::int64_t* time : {&of.raised_ms, &of.gone_ms, &of.acknowledged_ms}) visit(*time);
  visit(of.acknowledged_by);
  visit(of.times);
  visit(of.time_s);
  visit(of.text);
  visit(of.indicators);
}

template <class Visitor>
void each(Visitor& visit, SiteReport& of) {
  each(visit, of.summary);
  visit(of.samples);
  visit(of.energy_J);
  visit(of.indicators);
  visit(of.events);
  visit(of.alarms);
}

/// Whether it is UTF-8 without zero bytes, overlong forms and surrogates.
bool is_utf_8(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto first = static_cast<unsigned char>(text[at]);
    const std::size_t length = first < 0x80U ? 1 : (first >> 5U) == 6U ? 2 : (first >> 4U) == 14U ? 3 : 4;
    if (first == 0 || (length == 4 && (first >> 3U) != 30U) || at + length > text.size()) return false;
    std::uint32_t code = length == 1 ? first : first & (0xFFU >> (length + 1));
    for (std::size_t k = 1; k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[at + k]);
      if ((next >> 6U) != 2U) return false;
      code = code << 6U | (next & 0x3FU);
    }
    constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
    if (code < least[length] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return false;
    at += length;
  }
  return true;
}

struct Writer {
  std::vector<std::uint8_t> out;
  void operator()(std::uint64_t value) { numerics::put_little_endian(out, value); }
  void operator()(std::int64_t value) { (*this)(static_cast<std::uint64_t>(value)); }
  void operator()(std::uint32_t value) { numerics::put_little_endian(out, value); }
  void operator()(double value) { (*this)(std::bit_cast<std::uint64_t>(value)); }
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint32_t>(text.size()));
    out.insert(out.end(), text.begin(), text.end());
  }
  template <class Entry>
  void operator()(std::vector<Entry>& list) {
    (*this)(static_cast<std::uint32_t>(list.size()));
    for (Entry& one : list) each(*this, one);
  }
};

/// Nothing is made that is longer than the bytes that are left.
struct Reader {
  std::span<const std::uint8_t> in;
  bool good = true;

  template <class N>
  N number() {
    good = good && in.size() >= sizeof(N);
    if (!good) return 0;
    const N value = numerics::little_endian<N>(in, 0);
    in = in.subspan(sizeof(N));
    return value;
  }
  void operator()(std::uint64_t& value) { value = number<std::uint64_t>(); }
  void operator()(std::int64_t& value) { value = static_cast<std::int64_t>(number<std::uint64_t>()); }
  void operator()(std::uint32_t& value) { value = number<std::uint32_t>(); }
  void operator()(double& value) { value = std::bit_cast<double>(number<std::uint64_t>()); }
  void operator()(std::string& text) {
    const auto length = number<std::uint32_t>();
    good = good && length <= in.size();
    if (!good) return;
    text.assign(in.begin(), in.begin() + length);
    good = is_utf_8(text);  // a database keeps no other text, and would refuse all that came with it
    in = in.subspan(length);
  }
  template <class Entry>
  void operator()(std::vector<Entry>& list) {
    const auto count = number<std::uint32_t>();
    for (std::uint32_t k = 0; good && k < count; ++k) each(*this, list.emplace_back());
  }
};

}  // namespace

std::vector<std::uint8_t> write_report(const SiteReport& report) {
  Writer writer;
  SiteReport copy = report;
  each(writer, copy);
  return std::move(writer.out);
}

bool read_report(std::span<const std::uint8_t> bytes, SiteReport& report) {
  Reader reader{bytes};
  each(reader, report);
  constexpr std::int64_t most = std::int64_t{1} << 40U;
  for (const live::Alarm& one : report.alarms) reader.good = reader.good && one.id > 0 && one.id < most;
  return reader.good && reader.in.empty();
}

}  // namespace spoolflow::fleet

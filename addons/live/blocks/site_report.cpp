#include "addons/live/blocks/site_report.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

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
  visit.text(of.text);
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
  visit.text(of.text);
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

/// Bytes of the character that begins there: UTF-8 without overlong forms, surrogates and control characters; 0: none.
std::size_t character_at(std::string_view text, std::size_t at) {
  const auto first = static_cast<unsigned char>(text[at]);
  const std::size_t length = first < 0x80U ? 1 : (first >> 5U) == 6U ? 2 : (first >> 4U) == 14U ? 3 : 4;
  if ((length == 4 && (first >> 3U) != 30U) || at + length > text.size()) return 0;
  std::uint32_t code = length == 1 ? first : first & (0xFFU >> (length + 1));
  for (std::size_t k = 1; k < length; ++k) {
    const auto next = static_cast<unsigned char>(text[at + k]);
    if ((next >> 6U) != 2U) return 0;
    code = code << 6U | (next & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> least{0, 0x20, 0x80, 0x800, 0x10000};
  const bool controls = code >= 0x7F && code < 0xA0, is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  return code < least[length] || code > 0x10FFFF || controls || is_surrogate ? 0 : length;
}

bool is_plain(std::string_view text, std::size_t longest) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = character_at(text, at);
    if (length == 0) return false;
    at += length;
  }
  return text.size() <= longest;
}

std::string plain(std::string_view text, std::size_t longest) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = character_at(text, at), taken = std::max(length, std::size_t{1});
    if (out.size() + taken > longest) break;
    out += length > 0 ? text.substr(at, length) : "?";
    at += taken;
  }
  return out;
}

struct Writer {
  std::vector<std::uint8_t> out;
  void operator()(std::uint64_t value) { numerics::put_little_endian(out, value); }
  void operator()(std::int64_t value) { (*this)(static_cast<std::uint64_t>(value)); }
  void operator()(std::uint32_t value) { numerics::put_little_endian(out, value); }
  void operator()(double value) {
    const bool is_known = std::abs(value) <= largest_number;
    (*this)(std::bit_cast<std::uint64_t>(is_known ? value : std::numeric_limits<double>::quiet_NaN()));
  }
  void operator()(const std::string& word) { put(plain(word, longest_word)); }
  void text(const std::string& text) { put(plain(text, longest_text)); }
  void put(const std::string& text) {
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
  void operator()(double& value) {
    value = std::bit_cast<double>(number<std::uint64_t>());
    good = good && !(std::abs(value) > largest_number);
  }
  void operator()(std::string& word) { take(word, longest_word); }
  void text(std::string& text) { take(text, longest_text); }
  void take(std::string& text, std::size_t longest) {
    const auto length = number<std::uint32_t>();
    good = good && length <= in.size() && length <= longest;
    if (!good) return;
    text.assign(in.begin(), in.begin() + length);
    good = is_plain(text, longest);  // a database keeps no other text, and would refuse all that came with it
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
  const bool totals = report.summary.samples >= 0 && report.summary.samples < most && report.samples < largest_count &&
                      std::isfinite(report.energy_J);
  const auto kept_event = [](const live::Event& one) { return is_wall_ms(one.wall_ms); };
  const auto kept_alarm = [](const live::Alarm& one) {
    return one.id > 0 && one.id < most && one.times >= 0 && one.times < most && is_wall_ms(one.raised_ms) &&
           is_wall_ms(one.gone_ms) && is_wall_ms(one.acknowledged_ms);
  };
  return reader.good && reader.in.empty() && totals && std::ranges::all_of(report.events, kept_event) &&
         std::ranges::all_of(report.alarms, kept_alarm);
}

}  // namespace spoolflow::fleet

#include "spoolflow/recording/files/clock_time.hpp"

#include <charconv>
#include <chrono>

namespace spoolflow::recording {
namespace {

/// Takes text off from the front, piece by piece.
class Pieces {
 public:
  explicit Pieces(std::string_view text) : rest_(text) {}

  /// Exactly so many digits.
  std::optional<int> digits(std::size_t count) {
    if (rest_.size() < count) return std::nullopt;
    int value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + count, value);
    if (error != std::errc{} || end != rest_.data() + count || rest_.front() == '-') return std::nullopt;
    rest_.remove_prefix(count);
    return value;
  }
  bool sign(std::string_view any_of) {
    if (rest_.empty() || any_of.find(rest_.front()) == std::string_view::npos) return false;
    rest_.remove_prefix(1);
    return true;
  }
  /// What follows a decimal sign.
  double share() {
    double value = 0, unit = 0.1;
    while (!rest_.empty() && rest_.front() >= '0' && rest_.front() <= '9') {
      value += unit * (rest_.front() - '0');
      unit *= 0.1;
      rest_.remove_prefix(1);
    }
    return value;
  }
  [[nodiscard]] bool done() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

std::optional<std::int64_t> day_of(int year, int month, int day) {
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(year), std::chrono::month(static_cast<unsigned>(month)),
                            std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok()) return std::nullopt;
  return sys_days(date).time_since_epoch().count();
}

/// hh:mm, and perhaps seconds with their share.
std::optional<double> second_of_day(Pieces& pieces) {
  const auto hour = pieces.digits(2);
  if (!hour || *hour > 23 || !pieces.sign(":")) return std::nullopt;
  const auto minute = pieces.digits(2);
  if (!minute || *minute > 59) return std::nullopt;
  double out = 3600.0 * *hour + 60.0 * *minute;
  if (!pieces.sign(":")) return out;
  const auto second = pieces.digits(2);
  if (!second || *second > 60) return std::nullopt;
  out += *second;
  if (pieces.sign(".,")) out += pieces.share();
  return out;
}

/// Z, +01:00, -0530 or nothing.
std::optional<double> offset_s(Pieces& pieces) {
  if (pieces.done() || (pieces.sign("Z") && pieces.done())) return 0.0;
  const double sign = pieces.sign("+") ? 1 : pieces.sign("-") ? -1 : 0;
  const auto hour = pieces.digits(2);
  if (sign == 0 || !hour) return std::nullopt;
  (void)pieces.sign(":");
  const auto minute = pieces.done() ? std::optional(0) : pieces.digits(2);
  if (!minute || !pieces.done()) return std::nullopt;
  return sign * (3600.0 * *hour + 60.0 * *minute);
}

/// The date at the front, with what parts it from the time.
std::optional<std::int64_t> date(Pieces& pieces, std::string_view text) {
  const bool year_first = text.size() > 4 && text[4] == '-';
  const auto first = pieces.digits(year_first ? 4 : 2);
  if (!first || !pieces.sign(year_first ? "-" : ".")) return std::nullopt;
  const auto month = pieces.digits(2);
  if (!month || !pieces.sign(year_first ? "-" : ".")) return std::nullopt;
  const auto last = pieces.digits(year_first ? 2 : 4);
  if (!last || !pieces.sign(year_first ? "T " : " ")) return std::nullopt;
  return year_first ? day_of(*first, *month, *last) : day_of(*last, *month, *first);
}

/// One digit or two.
std::optional<int> short_number(Pieces& pieces) {
  if (const auto two = pieces.digits(2)) return two;
  return pieces.digits(1);
}

/// 3/4/2025 11:59:59.700 AM: month, day, year, as programs with American settings write them. Without AM or PM nothing
/// returns which comes first.
std::optional<ClockTime> american(std::string_view text) {
  const bool after_noon = text.ends_with("PM") || text.ends_with("pm");
  if (!after_noon && !text.ends_with("AM") && !text.ends_with("am")) return std::nullopt;
  text.remove_suffix(2);
  if (text.ends_with(' ')) text.remove_suffix(1);
  Pieces pieces(text);
  ClockTime out;
  if (text.find('/') != std::string_view::npos) {
    const auto month = short_number(pieces);
    if (!month || !pieces.sign("/")) return std::nullopt;
    const auto day = short_number(pieces);
    if (!day || !pieces.sign("/")) return std::nullopt;
    const auto year = pieces.digits(4);
    if (!year || !pieces.sign(" ")) return std::nullopt;
    const auto date = day_of(*year, *month, *day);
    if (!date) return std::nullopt;
    out.day = *date;
  }
  const auto hour = short_number(pieces);
  if (!hour || *hour < 1 || *hour > 12 || !pieces.sign(":")) return std::nullopt;
  const auto minute = pieces.digits(2);
  if (!minute || *minute > 59) return std::nullopt;
  out.second = 3600.0 * (*hour % 12 + (after_noon ? 12 : 0)) + 60.0 * *minute;
  if (pieces.sign(":")) {
    const auto second = pieces.digits(2);
    if (!second || *second > 60) return std::nullopt;
    out.second += *second + (pieces.sign(".,") ? pieces.share() : 0.0);
  }
  if (!pieces.done()) return std::nullopt;
  return out;
}

}  // namespace

std::optional<ClockTime> read_clock_time(std::string_view text) {
  if (text.size() < 5) return std::nullopt;
  if (const auto out = american(text)) return out;
  Pieces pieces(text);
  ClockTime out;
  const bool dated = text.size() > 8 && text[2] != ':';
  if (dated) {
    const auto day = date(pieces, text);
    if (!day) return std::nullopt;
    out.day = *day;
  }
  const auto second = second_of_day(pieces);
  if (!second) return std::nullopt;
  const auto offset = offset_s(pieces);
  if (!offset) return std::nullopt;
  out.second = *second - *offset;
  return out;
}

}  // namespace spoolflow::recording

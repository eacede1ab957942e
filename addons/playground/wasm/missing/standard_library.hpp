#pragma once
/// What of C++20 the standard library of emscripten 3.1.6 (libc++ 13) lacks and this project uses: algorithms over
/// ranges, bits taken for another type, and numbers in their shortest text or with fixed decimals. Included before
/// every source of the playground's build and of no other.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <functional>
#include <iterator>
#include <memory>
#include <ranges>
#include <string>

#define FMT_HEADER_ONLY 1
#include <fmt/format.h>

static_assert(_LIBCPP_VERSION < 15000, "a newer library has these itself: remove this header and what includes it");

namespace std {

/// Shortest digits that read back as the same number, in the shorter of both notations, the plain one where both are as
/// short.
template <floating_point Number>
to_chars_result to_chars(char* first, char* last, Number value) {
  std::string text = fmt::format("{}", value);
  if (std::isfinite(value) && value != 0) {
    const auto parts = fmt::detail::dragonbox::to_decimal(std::abs(value));
    const std::string digits = fmt::format("{}", parts.significand);
    const int count = static_cast<int>(digits.size());
    const std::string sign = std::signbit(value) ? "-" : "";
    const int power = parts.exponent + count - 1;
    const std::string scientific = sign + digits.substr(0, 1) + (count > 1 ? "." + digits.substr(1) : "") +
                                   fmt::format("e{}{:02}", power < 0 ? '-' : '+', power < 0 ? -power : power);
    std::string plain = sign;
    if (parts.exponent >= 0) {
      plain = power > 30 ? std::string(64, '0') : fmt::format("{:.0f}", value);
    } else if (power >= 0) {
      plain += digits.substr(0, power + 1) + "." + digits.substr(power + 1);
    } else {
      plain += power < -30 ? std::string(64, '0') : "0." + std::string(-power - 1, '0') + digits;
    }
    text = plain.size() <= scientific.size() ? plain : scientific;
  }
  if (last - first < static_cast<ptrdiff_t>(text.size())) return {last, errc::value_too_large};
  return {std::copy(text.begin(), text.end(), first), errc()};
}

/// With so many decimals; of the formats `fixed` alone.
template <floating_point Number>
to_chars_result to_chars(char* first, char* last, Number value, chars_format, int decimals) {
  const auto put = fmt::format_to_n(first, last - first, "{:.{}f}", value, decimals);
  if (put.size > static_cast<size_t>(last - first)) return {last, errc::value_too_large};
  return {put.out, errc()};
}

/// The compiler knows it, the library's header does not yet.
template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
  static_assert(sizeof(To) == sizeof(From));
  return __builtin_bit_cast(To, from);
}

/// Memory that nobody reads before it is written; zeros are as good.
template <class Object>
unique_ptr<Object> make_unique_for_overwrite() {
  return unique_ptr<Object>(new Object);
}

namespace ranges {
namespace spoolflow_missing {

/// The predicate of what the projection makes of an element.
template <class Predicate, class Projection>
auto of_projection(Predicate& predicate, Projection& projection) {
  return [&](auto&& element) -> bool { return std::invoke(predicate, std::invoke(projection, element)); };
}
template <class Compare, class Projection>
auto of_both(Compare& compare, Projection& projection) {
  return [&](auto&& a, auto&& b) -> bool {
    return std::invoke(compare, std::invoke(projection, a), std::invoke(projection, b));
  };
}

}  // namespace spoolflow_missing

template <class Range, class Value, class Projection = identity>
auto find(Range&& range, const Value& value, Projection projection = {}) {
  return std::find_if(ranges::begin(range), ranges::end(range),
                      [&](auto&& element) { return std::invoke(projection, element) == value; });
}
template <class Range, class Predicate, class Projection = identity>
auto find_if(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::find_if(ranges::begin(range), ranges::end(range),
                      spoolflow_missing::of_projection(predicate, projection));
}
template <class Range, class Value, class Projection = identity>
auto count(Range&& range, const Value& value, Projection projection = {}) {
  return std::count_if(ranges::begin(range), ranges::end(range),
                       [&](auto&& element) { return std::invoke(projection, element) == value; });
}
template <class Range, class Predicate, class Projection = identity>
auto count_if(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::count_if(ranges::begin(range), ranges::end(range),
                       spoolflow_missing::of_projection(predicate, projection));
}
template <class Range, class Predicate, class Projection = identity>
bool any_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::any_of(ranges::begin(range), ranges::end(range), spoolflow_missing::of_projection(predicate, projection));
}
template <class Range, class Predicate, class Projection = identity>
bool all_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::all_of(ranges::begin(range), ranges::end(range), spoolflow_missing::of_projection(predicate, projection));
}
template <class Range, class Predicate, class Projection = identity>
bool none_of(Range&& range, Predicate predicate, Projection projection = {}) {
  return std::none_of(ranges::begin(range), ranges::end(range),
                      spoolflow_missing::of_projection(predicate, projection));
}
template <input_iterator Place, class Predicate>
bool none_of(Place first, Place last, Predicate predicate) {
  return std::none_of(first, last, predicate);
}
template <class Range, class Compare = less, class Projection = identity>
void sort(Range&& range, Compare compare = {}, Projection projection = {}) {
  std::sort(ranges::begin(range), ranges::end(range), spoolflow_missing::of_both(compare, projection));
}
template <class Range, class Compare = less, class Projection = identity>
void stable_sort(Range&& range, Compare compare = {}, Projection projection = {}) {
  std::stable_sort(ranges::begin(range), ranges::end(range), spoolflow_missing::of_both(compare, projection));
}
template <class Range, class Value, class Compare = less, class Projection = identity>
auto lower_bound(Range&& range, const Value& value, Compare compare = {}, Projection projection = {}) {
  return std::lower_bound(ranges::begin(range), ranges::end(range), value, [&](auto&& element, const Value& sought) {
    return std::invoke(compare, std::invoke(projection, element), sought);
  });
}
template <class Place, class Value, class Compare, class Projection>
auto upper_bound_between(Place first, Place last, const Value& value, Compare compare, Projection projection) {
  return std::upper_bound(first, last, value, [&](const Value& sought, auto&& element) {
    return std::invoke(compare, sought, std::invoke(projection, element));
  });
}
template <range Range, class Value, class Compare = less, class Projection = identity>
auto upper_bound(Range&& range, const Value& value, Compare compare = {}, Projection projection = {}) {
  return upper_bound_between(ranges::begin(range), ranges::end(range), value, compare, projection);
}
template <input_iterator Place, class Value>
auto upper_bound(Place first, Place last, const Value& value) {
  return upper_bound_between(first, last, value, less{}, identity{});
}
template <class Range, class Out>
void move(Range&& range, Out out) {
  std::move(ranges::begin(range), ranges::end(range), out);
}
template <class Range, class Value>
void replace(Range&& range, const Value& before, const Value& after) {
  std::replace(ranges::begin(range), ranges::end(range), before, after);
}
template <class Range, class Place, class Compare = less, class Projection = identity>
void nth_element(Range&& range, Place nth, Compare compare = {}, Projection projection = {}) {
  std::nth_element(ranges::begin(range), nth, ranges::end(range), spoolflow_missing::of_both(compare, projection));
}
template <class Range, class Compare = less, class Projection = identity>
auto max_element(Range&& range, Compare compare = {}, Projection projection = {}) {
  return std::max_element(ranges::begin(range), ranges::end(range), spoolflow_missing::of_both(compare, projection));
}
template <class Range, class Compare = less, class Projection = identity>
auto min_element(Range&& range, Compare compare = {}, Projection projection = {}) {
  return std::min_element(ranges::begin(range), ranges::end(range), spoolflow_missing::of_both(compare, projection));
}
template <class Range, class Compare = less, class Projection = identity>
auto max(Range&& range, Compare compare = {}, Projection projection = {}) {
  return *ranges::max_element(range, compare, projection);
}
template <class Value>
struct min_max_result {
  Value min, max;
};
template <class Range>
auto minmax(Range&& range) {
  const auto [least, most] = std::minmax_element(ranges::begin(range), ranges::end(range));
  return min_max_result<std::decay_t<decltype(*least)>>{*least, *most};
}
template <class Range, class Out, class Function, class Projection = identity>
void transform(Range&& range, Out out, Function function, Projection projection = {}) {
  std::transform(ranges::begin(range), ranges::end(range), out,
                 [&](auto&& element) { return std::invoke(function, std::invoke(projection, element)); });
}
template <class Range>
void reverse(Range&& range) {
  std::reverse(ranges::begin(range), ranges::end(range));
}
template <class Range, class Value>
void fill(Range&& range, const Value& value) {
  std::fill(ranges::begin(range), ranges::end(range), value);
}
template <class Range, class Out>
void copy(Range&& range, Out out) {
  std::copy(ranges::begin(range), ranges::end(range), out);
}
template <class Range, class Out, class Predicate, class Projection = identity>
void copy_if(Range&& range, Out out, Predicate predicate, Projection projection = {}) {
  std::copy_if(ranges::begin(range), ranges::end(range), out, spoolflow_missing::of_projection(predicate, projection));
}
template <class Range, class Predicate, class Value, class Projection = identity>
void replace_if(Range&& range, Predicate predicate, const Value& value, Projection projection = {}) {
  std::replace_if(ranges::begin(range), ranges::end(range), spoolflow_missing::of_projection(predicate, projection),
                  value);
}
template <class Range, class Compare = equal_to, class Projection = identity>
auto adjacent_find(Range&& range, Compare compare = {}, Projection projection = {}) {
  return std::adjacent_find(ranges::begin(range), ranges::end(range), spoolflow_missing::of_both(compare, projection));
}
template <class A, class B, class Compare = equal_to, class ProjectionA = identity, class ProjectionB = identity>
bool equal(A&& a, B&& b, Compare compare = {}, ProjectionA of_a = {}, ProjectionB of_b = {}) {
  return std::equal(ranges::begin(a), ranges::end(a), ranges::begin(b), ranges::end(b), [&](auto&& x, auto&& y) {
    return std::invoke(compare, std::invoke(of_a, x), std::invoke(of_b, y));
  });
}

}  // namespace ranges
}  // namespace std

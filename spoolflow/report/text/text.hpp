#pragma once
/// Text in which quantities are not written out yet. What is not a quantity (names of runs, files and models) is never
/// looked at again, whatever it looks like.
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "spoolflow/report/text/quantity_text.hpp"

namespace spoolflow::report {

class Text {
 public:
  using WrittenIn = std::function<std::string(const ReaderUnits&)>;

  Text() = default;
  // Whatever can be read is text.
  Text(std::string plain) : plain_(std::move(plain)) {}  // NOLINT(google-explicit-constructor)
  Text(const char* plain) : plain_(plain) {}             // NOLINT(google-explicit-constructor)
  Text(std::string_view plain) : plain_(plain) {}        // NOLINT(google-explicit-constructor)
  Text(const QuantityText& quantity);                    // NOLINT(google-explicit-constructor)
  explicit Text(WrittenIn open) : open_(std::move(open)) {}

  [[nodiscard]] std::string in(const ReaderUnits& units) const { return open_ ? open_(units) : plain_; }
  /// In the usual units.
  [[nodiscard]] std::string str() const { return in({}); }
  [[nodiscard]] bool empty() const { return !open_ && plain_.empty(); }
  Text& operator+=(const Text& more);

 private:
  std::string plain_;
  WrittenIn open_;  ///< instead of `plain_`
};

/// "slow_ramps" as "slow ramps".
[[nodiscard]] std::string spaced(std::string_view name);

/// The unit alone: "bar".
[[nodiscard]] Text unit_text(units::Kind kind);

/// Quantities written out, all else as it is.
[[nodiscard]] inline std::string written(const QuantityText& quantity, const ReaderUnits& units) {
  return quantity.in(units);
}
[[nodiscard]] inline std::string written(const Text& text, const ReaderUnits& units) {
  return text.in(units);
}
template <class Other>
[[nodiscard]] const Other& written(const Other& other, const ReaderUnits& /*units*/) {
  return other;
}

/// What a text keeps of an argument: letters that others own might be gone when it is written out.
template <class Argument>
using Kept = std::conditional_t<std::is_convertible_v<Argument, std::string_view>, std::string, std::decay_t<Argument>>;
/// What takes its place.
template <class Argument>
using Written = std::decay_t<decltype(written(std::declval<const Kept<Argument>&>(), ReaderUnits{}))>;

/// As fmt::format, with quantities and other texts among the arguments: phrase("at {}", fixed(units::pressure(p_Pa),
/// 0)).
template <class... Arguments>
[[nodiscard]] Text phrase(fmt::format_string<Written<Arguments>...> pattern, Arguments&&... arguments) {
  return Text([pattern, ... kept = Kept<Arguments>(std::forward<Arguments>(arguments))](const ReaderUnits& units) {
    return fmt::format(pattern, Written<Arguments>(written(kept, units))...);
  });
}

/// "0.00 to 2.40 mm"; one number where both are written alike.
[[nodiscard]] Text range_text(const QuantityText& lowest, const QuantityText& highest);

}  // namespace spoolflow::report

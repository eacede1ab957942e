#pragma once
/// The eight colours of maps drawn by colour.
#include <array>
#include <cstddef>
#include <string>

namespace spoolflow::report {

class HeatScale {
 public:
  /// `from`: the colours' lower ends, rising, in the quantity's unit.
  explicit constexpr HeatScale(const std::array<double, 8>& from) : from_(from) {}

  /// Number of the value's colour, 0 to 7; the page's styles call them h0 to h7. A value below the first end has -1.
  [[nodiscard]] int colour(double value) const;
  /// The colours with the ranges that they stand for, as HTML. `title`: what the colours show, with its unit.
  [[nodiscard]] std::string legend(const std::string& title) const;

 private:
  std::array<double, 8> from_;
};

/// A coloured box and what it stands for, as HTML; `look`: the box's class or style attribute.
[[nodiscard]] std::string colour_key(const std::string& look, const std::string& text);

}  // namespace spoolflow::report

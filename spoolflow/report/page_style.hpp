#pragma once
#include <string_view>

namespace spoolflow::report {

/// The style sheet of every page: light, dark, print, narrow screens. Colours of data are told apart by the
/// colour-blind: blue and orange (after Okabe and Ito), a family of one hue from pale to deep, and yellow to brown for
/// heat.
[[nodiscard]] std::string_view page_style();

}  // namespace spoolflow::report

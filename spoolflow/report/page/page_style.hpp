#pragma once
#include <string_view>

namespace spoolflow::report {

/// The style sheet of every page: light, dark, print, narrow screens. Its source is web/src/style.
[[nodiscard]] std::string_view page_style();

/// The script of every page: colours and units of the reader's choice, plots that zoom. Its source is web/src.
[[nodiscard]] std::string_view page_script();

}  // namespace spoolflow::report

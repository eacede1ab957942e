#pragma once
/// What was asked of the sensor, and whether it was met.
#include <string>

#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

/// "All 4 limits of limits.toml are met."
[[nodiscard]] std::string requirements_sentence(const validation::Validation& validation);
/// "95 % of the observer's errors in motion below 5 % FS".
[[nodiscard]] Text limit_text(const validation::JudgedLimit& judged);
/// "4.31 % FS", or that nothing was found, and why.
[[nodiscard]] Text value_text(const validation::JudgedLimit& judged);

/// Nothing where nothing was asked.
void show_requirements(HtmlPage& page, const validation::Validation& validation);

}  // namespace spoolflow::report

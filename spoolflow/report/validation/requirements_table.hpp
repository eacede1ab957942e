#pragma once
/// What was asked of the sensor, and whether it was met.
#include <string>
#include <vector>

#include "spoolflow/report/page/html_page.hpp"
#include "spoolflow/validation/validate.hpp"

namespace spoolflow::report {

/// "All 4 limits of limits.toml are met."
[[nodiscard]] std::string requirements_sentence(const validation::Validation& validation);
/// "95 % of the observer's errors in motion below 5 % FS".
[[nodiscard]] Text limit_text(const validation::JudgedLimit& judged);
/// "4.31 % FS", or that nothing was found, and why.
[[nodiscard]] Text value_text(const validation::JudgedLimit& judged);

/// The limits that were asked, or the default ones where none were; empty where no run has a reference flow and nothing
/// was asked.
[[nodiscard]] std::vector<validation::JudgedLimit> shown_limits(const validation::Validation& validation,
                                                                double full_scale_m3_per_s);
/// In one line: pass, fail or not judged, and by which limits.
void show_requirements(HtmlPage& page, const validation::Validation& validation,
                       const std::vector<validation::JudgedLimit>& limits);
/// A row a limit.
void show_limits(HtmlPage& page, const std::vector<validation::JudgedLimit>& limits);

}  // namespace spoolflow::report

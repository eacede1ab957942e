#pragma once
/// The text in which a study keeps its finished runs, one line each.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace spoolflow::analysis {

/// What one simulated run gives, of each estimator, as shares of full scale.
inline constexpr std::size_t study_outputs = 4;
using RunErrors = std::array<double, study_outputs>;

using FinishedRuns = std::vector<std::optional<RunErrors>>;  // by the index in the design

/// One line of heading with the study's fingerprint, one line a finished run with its exact numbers.
[[nodiscard]] std::string study_state(std::uint64_t fingerprint, const FinishedRuns& runs);

/// What such a text holds of `count` runs; nothing of another study's, nor of damaged lines.
[[nodiscard]] FinishedRuns finished_runs(const std::string& text, std::uint64_t fingerprint, std::size_t count);

/// The same of runs that are lines of text themselves.
using FinishedLines = std::vector<std::optional<std::string>>;
[[nodiscard]] std::string study_lines_state(std::uint64_t fingerprint, const FinishedLines& lines);
[[nodiscard]] FinishedLines finished_lines(const std::string& text, std::uint64_t fingerprint, std::size_t count);

/// A number that changes with any letter of the text.
[[nodiscard]] std::uint64_t fingerprint_of(const std::string& text);

}  // namespace spoolflow::analysis

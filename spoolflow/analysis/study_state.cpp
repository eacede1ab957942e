#include "spoolflow/analysis/study_state.hpp"

#include <cstdlib>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "spoolflow/uncertainty/seeded_numbers.hpp"

namespace spoolflow::analysis {
namespace {

std::string heading(std::uint64_t fingerprint) {
  return fmt::format("spoolflow study 1, {:016x}: finished runs of an interrupted `analyse`, safe to delete",
                     fingerprint);
}

}  // namespace

std::string study_lines_state(std::uint64_t fingerprint, const FinishedLines& lines) {
  std::string out = heading(fingerprint) + "\n";
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (lines[k]) out += fmt::format("{} {} end\n", k, *lines[k]);
  }
  return out;
}

FinishedLines finished_lines(const std::string& text, std::uint64_t fingerprint, std::size_t count) {
  FinishedLines out(count);
  std::istringstream lines(text);
  std::string line;
  if (!std::getline(lines, line) || line != heading(fingerprint)) return out;
  constexpr std::string_view ending = " end";
  while (std::getline(lines, line)) {
    if (!line.ends_with(ending)) continue;
    char* next = line.data();
    const std::uint64_t index = std::strtoull(next, &next, 10);
    if (index < count && *next == ' ') out[index] = std::string(next + 1, line.data() + line.size() - ending.size());
  }
  return out;
}

std::string study_state(std::uint64_t fingerprint, const FinishedRuns& runs) {
  FinishedLines lines(runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k]) lines[k] = fmt::format("{:a}", fmt::join(*runs[k], " "));
  }
  return study_lines_state(fingerprint, lines);
}

FinishedRuns finished_runs(const std::string& text, std::uint64_t fingerprint, std::size_t count) {
  FinishedRuns out(count);
  const FinishedLines lines = finished_lines(text, fingerprint, count);
  for (std::size_t k = 0; k < count; ++k) {
    if (!lines[k]) continue;
    const char* next = lines[k]->c_str();
    RunErrors errors{};
    for (double& value : errors) {
      char* after = nullptr;
      value = std::strtod(next, &after);
      next = after;
    }
    if (*next == '\0') out[k] = errors;
  }
  return out;
}

std::uint64_t fingerprint_of(const std::string& text) {
  std::uint64_t hash = 0;
  for (const char letter : text) hash = uncertainty::mixed_bits(hash ^ static_cast<unsigned char>(letter));
  return hash;
}

}  // namespace spoolflow::analysis

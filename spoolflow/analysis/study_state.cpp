#include "spoolflow/analysis/study_state.hpp"

#include <cstdlib>
#include <sstream>

#include <fmt/format.h>

#include "spoolflow/uncertainty/seeded_numbers.hpp"

namespace spoolflow::analysis {
namespace {

std::string heading(std::uint64_t fingerprint) {
  return fmt::format("spoolflow study 1, {:016x}: finished runs of an interrupted `analyse`, safe to delete",
                     fingerprint);
}

}  // namespace

std::string study_state(std::uint64_t fingerprint, const FinishedRuns& runs) {
  std::string out = heading(fingerprint) + "\n";
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (!runs[k]) continue;
    out += fmt::format("{}", k);
    for (const double value : *runs[k]) out += fmt::format(" {:a}", value);
    out += " end\n";
  }
  return out;
}

FinishedRuns finished_runs(const std::string& text, std::uint64_t fingerprint, std::size_t count) {
  FinishedRuns out(count);
  std::istringstream lines(text);
  std::string line;
  if (!std::getline(lines, line) || line != heading(fingerprint)) return out;
  while (std::getline(lines, line)) {
    if (!line.ends_with(" end")) continue;
    char* next = line.data();
    const std::uint64_t index = std::strtoull(next, &next, 10);
    RunErrors errors{};
    for (double& value : errors) value = std::strtod(next, &next);
    if (index < count && std::string_view(next) == " end") out[index] = errors;
  }
  return out;
}

std::uint64_t fingerprint_of(const std::string& text) {
  std::uint64_t hash = 0;
  for (const char letter : text) hash = uncertainty::mixed_bits(hash ^ static_cast<unsigned char>(letter));
  return hash;
}

}  // namespace spoolflow::analysis

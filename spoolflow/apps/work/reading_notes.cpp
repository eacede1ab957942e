#include "spoolflow/apps/work/reading_notes.hpp"

#include <fmt/format.h>

namespace spoolflow::apps {

std::string repeated_times_text(std::uint64_t repeated, std::uint64_t samples) {
  std::string out = fmt::format("{} samples repeat the time stamp before them", repeated);
  if (2 * repeated >= samples && repeated < samples)
    out += fmt::format(" ({:.3g} have the same time on average: write the times with more digits)",
                       static_cast<double>(samples) / static_cast<double>(samples - repeated));
  return out;
}

std::vector<std::string> notes_text(const recording::ReadNotes& notes, const std::string& file) {
  std::vector<std::string> out;
  if (notes.duplicate_times > 0) {
    out.push_back(fmt::format("{}: {}; each is estimated, with status time_fault", file,
                              repeated_times_text(notes.duplicate_times, notes.rows)));
  }
  if (notes.missing_values > 0) {
    out.push_back(fmt::format("{}: {} values are missing; the estimate is held there, with status sample_missing", file,
                              notes.missing_values));
  }
  if (notes.missing_times + notes.backward_times > 0) {
    out.push_back(fmt::format(
        "{}: {} samples have no time stamp, of {} it runs back; the estimate is held there, with status time_fault",
        file, notes.missing_times, notes.backward_times));
  }
  if (!notes.resampled.empty()) out.push_back(fmt::format("{}: {}", file, notes.resampled));
  if (notes.left_out > 0)
    out.push_back(fmt::format("{}: {} lines are no samples and have no row", file, notes.left_out));
  return out;
}

}  // namespace spoolflow::apps

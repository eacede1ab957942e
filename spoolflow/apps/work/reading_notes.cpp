#include "spoolflow/apps/work/reading_notes.hpp"

#include <fmt/format.h>

namespace spoolflow::apps {

std::vector<std::string> notes_text(const recording::ReadNotes& notes, const std::string& file) {
  std::vector<std::string> out;
  if (notes.duplicate_times > 0) {
    out.push_back(
        fmt::format("{}: {} samples repeat the time stamp before them; each is estimated, with status time_fault", file,
                    notes.duplicate_times));
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

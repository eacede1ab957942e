#include "spoolflow/recording/time_stamps.hpp"

#include <fmt/format.h>

#include "spoolflow/recording/recording_error.hpp"

namespace spoolflow::recording {

void TimeStamps::refuse(double now_s, std::uint64_t line) const {
  if (std::isnan(now_s)) {
    throw RecordingError(
        fmt::format("{}, line {}: the time stamp is missing; remove the row or fill it in", file_, line));
  }
  throw RecordingError(
      fmt::format("{}, line {}: time runs backwards, from {:.9g} s to {:.9g} s; sort the rows by time, or cut the "
                  "file where the recorder was restarted",
                  file_, line, last_s_, now_s));
}

}  // namespace spoolflow::recording

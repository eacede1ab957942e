#include "spoolflow/recording/tdms/tdms_pauses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace spoolflow::recording {
namespace {

constexpr double share_of_pause = 0.5;  ///< by which a channel is late that slides; one that does not is late by none
constexpr double steps_of_a_pause = 2;  ///< a shorter one is within what buffers hold back

/// How far a channel has come.
struct Course {
  std::uint64_t samples = 0;
  double end_s = 0;          ///< behind its last sample
  double step_s = 0;         ///< of the last run
  double late_s = 0;         ///< of end_s against the furthest channel, when its last run ended
  double furthest_s = 0;     ///< where that one was then
  std::size_t next_run = 0;  ///< the run behind its last one
};

/// All channels, run after run.
class Courses {
 public:
  Courses(const TdmsContents& contents, const std::vector<EvenTimes>& times)
      : times_(times), courses_(contents.channels.size()), out_(contents.channels.size()) {
    for (std::size_t k = 0; k < times.size(); ++k) {
      if (!times[k].empty() && contents.channels[k].samples > 0) furthest_s_ = std::min(furthest_s_, times[k].at(0));
    }
    for (Course& course : courses_) course.furthest_s = furthest_s_;
    for (const TdmsRun& run : contents.runs) follow(run);
  }
  [[nodiscard]] std::vector<std::string> why() { return std::move(out_); }

 private:
  void follow(const TdmsRun& run) {
    const double before_s = furthest_s_;
    for (const TdmsPart& part : run.chunk->parts) {
      if (!counts(part)) continue;
      Course& course = courses_[part.channel];
      const EvenTimes& times = times_[part.channel];
      course.samples += part.count * run.chunks;
      course.end_s = times.at(course.samples);
      course.step_s = course.end_s - times.at(course.samples - 1);
      furthest_s_ = std::max(furthest_s_, course.end_s);
    }
    for (const TdmsPart& part : run.chunk->parts) {
      if (counts(part)) judge(part, run, before_s);
    }
    ++run_;
  }

  [[nodiscard]] bool counts(const TdmsPart& part) const { return part.count > 0 && !times_[part.channel].empty(); }

  /// What begins with a later run in which nothing else goes on, such as a group of its own, is not late.
  void judge(const TdmsPart& part, const TdmsRun& run, double before_s) {
    Course& course = courses_[part.channel];
    const double late_s = furthest_s_ - course.end_s;
    const double pause_s = before_s - course.furthest_s;
    const double own_s = static_cast<double>(part.count * run.chunks) * course.step_s;
    const bool begins = course.next_run == 0;
    const bool others_go_on = furthest_s_ - before_s > share_of_pause * own_s;
    const double more_s = late_s - course.late_s;
    if (course.next_run < run_ && (!begins || others_go_on) && more_s > share_of_pause * pause_s &&
        more_s > steps_of_a_pause * course.step_s && out_[part.channel].empty()) {
      out_[part.channel] = fmt::format(
          "is not read: it has no samples for {:.4g} s in which others have, and neither wf_start_time nor "
          "wf_start_offset of the segment at byte {} says when it goes on; let the program that writes it state one of "
          "them, or leave the segments before out",
          pause_s, run.segment);
    }
    course.late_s = late_s;
    course.furthest_s = furthest_s_;
    course.next_run = run_ + 1;
  }

  const std::vector<EvenTimes>& times_;
  std::vector<Course> courses_;
  std::vector<std::string> out_;
  double furthest_s_ = std::numeric_limits<double>::infinity();
  std::size_t run_ = 0;
};

}  // namespace

std::vector<std::string> why_samples_slide(const TdmsContents& contents, const std::vector<EvenTimes>& times) {
  return Courses(contents, times).why();
}

}  // namespace spoolflow::recording

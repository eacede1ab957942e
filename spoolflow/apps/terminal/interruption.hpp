#pragma once
/// Ctrl-C and SIGTERM in mid-run: unfinished outputs are removed, and the program ends at once, with status 130
/// or 143 as shells have it (128 and the signal).
#include <atomic>
#include <string>
#include <string_view>

namespace spoolflow::apps {

/// From now on an interruption ends the program with one line such as "spoolflow estimate: interrupted; nothing was
/// written". SIGPIPE and SIGXFSZ become errors of the write that caused them.
void end_cleanly_when_interrupted(std::string_view program);
/// Who speaks in that line from now on: "spoolflow estimate".
void interruption_speaker(std::string_view speaker);

/// What an interruption has to say about the outputs.
enum class OutputState { nothing_written, stream_begun, file_finished };
void interruption_output_state(OutputState state);

/// Keeps the name of a file that must not survive an interruption. At most 64 at a time.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(std::string path);
  ~UnfinishedFile();
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::atomic<const char*>* slot_ = nullptr;
};

/// Holds back interruptions in this thread while a file changes its name and what is to be said about it.
class InterruptionPause {
 public:
  InterruptionPause();
  ~InterruptionPause();
  InterruptionPause(const InterruptionPause&) = delete;
  InterruptionPause& operator=(const InterruptionPause&) = delete;
};

/// Until one comes; which it was. They must be held back in every thread; more of them change nothing from then on.
int wait_for_the_end();

}  // namespace spoolflow::apps

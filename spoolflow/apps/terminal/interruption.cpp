#include "spoolflow/apps/terminal/interruption.hpp"

#include <algorithm>
#include <array>
#include <csignal>
#include <cstring>
#include <pthread.h>
#include <stdexcept>
#include <unistd.h>

namespace spoolflow::apps {
namespace {

// All that the handler touches: lock-free atomics and fixed buffers, since it may run between any two instructions.
std::array<std::atomic<const char*>, 64> unfinished{};
std::atomic<OutputState> output_state{OutputState::nothing_written};
std::array<char, 64> speaker_text{};
std::atomic_flag is_ending = ATOMIC_FLAG_INIT;
bool terminal = false;
static_assert(std::atomic<const char*>::is_always_lock_free && std::atomic<OutputState>::is_always_lock_free);

void say_at_once(const char* text) {
  // Nothing can be done about a failed write here; the result is taken only because it must not be ignored.
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, std::strlen(text));
}

void remove_unfinished() {
  for (auto& slot : unfinished) {
    const char* path = slot.load();
    if (path != nullptr) unlink(path);
  }
}

/// Of an abort: the program goes on to end by it.
extern "C" void tidy_up(int) {
  remove_unfinished();
}

extern "C" void end_interrupted(int signal) {
  if (is_ending.test_and_set()) return;
  remove_unfinished();
  if (terminal) say_at_once("\r\033[K");  // a progress line may stand there
  say_at_once(speaker_text.data());
  switch (output_state.load()) {
    case OutputState::nothing_written:
      say_at_once(": interrupted; nothing was written\n");
      break;
    case OutputState::stream_begun:
      say_at_once(": interrupted; standard output is incomplete\n");
      break;
    case OutputState::file_finished:
      say_at_once(": interrupted; only the files finished before were written\n");
      break;
  }
  constexpr int ended_by_signal = 128;
  _exit(ended_by_signal + signal);
}

sigset_t interruptions() {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&set, number);
  return set;
}

}  // namespace

void end_cleanly_when_interrupted(std::string_view program) {
  interruption_speaker(program);
  terminal = isatty(STDERR_FILENO) == 1;
  struct sigaction action {};
  action.sa_handler = end_interrupted;
  action.sa_mask = interruptions();
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // ignored under nohup, and stays so
  std::signal(SIGABRT, tidy_up);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void interruption_speaker(std::string_view speaker) {
  const InterruptionPause pause;
  speaker_text.fill('\0');
  std::copy_n(speaker.begin(), std::min(speaker.size(), speaker_text.size() - 1), speaker_text.begin());
}

void interruption_output_state(OutputState state) {
  output_state = state;
}

UnfinishedFile::UnfinishedFile(std::string path) : path_(std::move(path)) {
  for (auto& slot : unfinished) {
    const char* empty = nullptr;
    if (slot.compare_exchange_strong(empty, path_.c_str())) {
      slot_ = &slot;
      return;
    }
  }
  throw std::logic_error("more than 64 outputs are open at once");
}

UnfinishedFile::~UnfinishedFile() {
  slot_->store(nullptr);
}

InterruptionPause::InterruptionPause() {
  const sigset_t set = interruptions();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

InterruptionPause::~InterruptionPause() {
  const sigset_t set = interruptions();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

int wait_for_the_end() {
  const sigset_t ends = interruptions();
  int number = 0;
  sigwait(&ends, &number);
  // The end is under way: another signal, as `timeout` sends to the whole group, would only turn it into a failure.
  for (const int each : {SIGINT, SIGTERM, SIGHUP}) std::signal(each, SIG_IGN);
  return number;
}

}  // namespace spoolflow::apps

#include "addons/fleet/jobs/piece_process.hpp"

#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <spawn.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

extern char** environ;

namespace spoolflow::fleet {
namespace {

constexpr const char* folder_begin = "spoolflow-piece-";
constexpr const char* own_program = "/proc/self/exe";

/// Processes of pieces are behind everything else that the machine does, sensors of live valves above all.
constexpr int niceness = 10;

/// spawn's attributes, destroyed with their owner.
struct Attributes {
  posix_spawnattr_t spawn{};
  posix_spawn_file_actions_t files{};
  Attributes() {
    posix_spawnattr_init(&spawn);
    posix_spawn_file_actions_init(&files);
  }
  ~Attributes() {
    posix_spawnattr_destroy(&spawn);
    posix_spawn_file_actions_destroy(&files);
  }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
};

pid_t start(const std::filesystem::path& folder) {
  Attributes with;
  // Of its own group, so that Ctrl-C at a terminal reaches the worker alone; and with no signal held back.
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&with.spawn, &none);
  posix_spawnattr_setpgroup(&with.spawn, 0);
  posix_spawnattr_setflags(&with.spawn, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  posix_spawn_file_actions_addchdir_np(&with.files, folder.c_str());
  posix_spawn_file_actions_addopen(&with.files, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&with.files, 1, "/dev/null", O_WRONLY, 0);
  std::string program = "spoolflow", command = "piece", parent = fmt::format("{}", ::getpid());
  std::vector<char*> arguments{program.data(), command.data(), parent.data(), nullptr};
  pid_t child = -1;
  const int error = posix_spawn(&child, own_program, &with.files, &with.spawn, arguments.data(), environ);
  if (error != 0) throw std::runtime_error(fmt::format("no process can be started for a piece (error {})", error));
  return child;
}

/// Of a folder's name; 0: it is none of ours.
pid_t owner_of(const std::string& name) {
  if (!name.starts_with(folder_begin)) return 0;
  pid_t out = 0;
  const char* const digits = name.c_str() + std::string_view(folder_begin).size();
  (void)std::from_chars(digits, name.c_str() + name.size(), out);
  return out;
}

}  // namespace

PieceFolder::PieceFolder() {
  std::string pattern =
      (std::filesystem::temp_directory_path() / fmt::format("{}{}-XXXXXX", folder_begin, ::getpid())).string();
  if (::mkdtemp(pattern.data()) == nullptr)
    throw std::runtime_error(fmt::format("{}: no folder can be made for a piece", pattern));
  path_ = pattern;
}

PieceFolder::~PieceFolder() {
  std::error_code ignored;  // what stays is removed at a later start
  std::filesystem::remove_all(path_, ignored);
}

void remove_abandoned_folders() {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::temp_directory_path(), ignored)) {
    const pid_t owner = owner_of(entry.path().filename().string());
    if (owner <= 0 || ::kill(owner, 0) == 0 || errno != ESRCH) continue;
    std::filesystem::remove_all(entry.path(), ignored);  // another user's stays
  }
}

int run_piece_process(const std::filesystem::path& folder, const std::function<bool()>& go_on) {
  constexpr std::chrono::milliseconds looks_every{10};
  constexpr int looks_between_questions = 50;
  const pid_t child = start(folder);
  int state = 0;
  for (int k = 1; ::waitpid(child, &state, WNOHANG) == 0; ++k) {
    if (k % looks_between_questions == 0 && !go_on()) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &state, 0);
      break;
    }
    std::this_thread::sleep_for(looks_every);
  }
  return WIFSIGNALED(state) ? -WTERMSIG(state) : WEXITSTATUS(state);
}

void become_piece_process() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // of the thread that started it, which waits for it
  (void)::setpriority(PRIO_PROCESS, 0, niceness);
}

}  // namespace spoolflow::fleet

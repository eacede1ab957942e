#include "addons/cross/firmware_library.hpp"

#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <spawn.h>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves it to programs

namespace spoolflow::exports {
namespace {

namespace fs = std::filesystem;

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "spoolflow-export-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw std::runtime_error(fmt::format("{}: no folder can be made there; set TMPDIR to one that can be written",
                                           fs::temp_directory_path().string()));
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Runs a program of the path in a folder, its output to `said` there. Returns its exit status.
int run(const std::vector<std::string>& words, const fs::path& folder) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "said", O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int refused = ::posix_spawnp(&child, words.front().c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (refused == ENOENT) {
    throw std::runtime_error(
        fmt::format("{} is not on the path: install gcc-arm-none-eabi, libnewlib-arm-none-eabi and "
                    "libstdc++-arm-none-eabi-newlib; in the sources `./run export c` does that",
                    words.front()));
  }
  if (refused != 0) throw std::system_error(refused, std::generic_category(), words.front());
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), words.front());
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

void run_well(const std::vector<std::string>& words, const fs::path& folder) {
  const int status = run(words, folder);
  if (status == 0) return;
  throw std::runtime_error(
      fmt::format("{} ended with status {}: {}", words.front(), status, content(folder / "said").substr(0, 400)));
}

std::vector<std::string> words_of(std::string_view options) {
  std::istringstream in{std::string(options)};
  return {std::istream_iterator<std::string>(in), {}};
}

}  // namespace

std::string firmware_library(const std::vector<ExportedFile>& sources, const FirmwareTarget& target) {
  const TemporaryFolder folder;
  for (const ExportedFile& source : sources) {
    fs::create_directories((folder.path() / source.name).parent_path());
    std::ofstream(folder.path() / source.name, std::ios::binary) << source.content;
  }
  std::vector<std::string> archive{"arm-none-eabi-ar", "rcsD", "libvalve_sensor.a"};
  for (const std::string unit : {"valve_sensor", "self_test"}) {
    std::vector<std::string> compile = words_of(
        "arm-none-eabi-g++ -std=c++17 -O2 -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics "
        "-fno-asynchronous-unwind-tables -fno-unwind-tables -fno-tree-loop-distribute-patterns -ffunction-sections "
        "-fdata-sections -DVALVE_SENSOR_LIBRARY -I.");
    for (const std::string& option : words_of(target.options)) compile.push_back(option);
    compile.insert(compile.end(), {"-c", unit + ".cpp", "-o", unit + ".o"});
    run_well(compile, folder.path());
    archive.push_back(unit + ".o");
  }
  run_well(archive, folder.path());
  return content(folder.path() / "libvalve_sensor.a");
}

}  // namespace spoolflow::exports

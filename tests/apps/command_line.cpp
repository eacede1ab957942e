#include "tests/apps/command_line.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sys/wait.h>

namespace spoolflow::apps {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

fs::path temporary_folder() {
  std::string name = (fs::temp_directory_path() / "spoolflow-command-XXXXXX").string();
  return ::mkdtemp(name.data()) == nullptr ? fs::path() : fs::path(name);
}

Answer run_in(const fs::path& folder, const std::string& arguments) {
  const fs::path said = temporary_folder();
  const std::string line = "cd '" + folder.string() + "' && { '" SPOOLFLOW_COMMAND "' " + arguments + " ; } > '" +
                           (said / "output").string() + "' 2> '" + (said / "message").string() + "'";
  const int status = std::system(line.c_str());
  Answer answer{WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read(said / "output"),
                read(said / "message")};
  fs::remove_all(said);
  return answer;
}

}  // namespace

Answer spoolflow(const std::string& arguments) {
  return run_in(".", arguments);
}

void CommandLine::SetUp() {
  folder = temporary_folder();
  ASSERT_FALSE(folder.empty());
}

void CommandLine::TearDown() {
  fs::remove_all(folder);
}

Answer CommandLine::run(const std::string& arguments) const {
  return run_in(folder, arguments);
}

std::string CommandLine::content(const fs::path& file) const {
  return read(folder / file);
}

void CommandLine::write(const fs::path& file, const std::string& text) const {
  std::ofstream(folder / file, std::ios::binary) << text;
}

std::vector<std::string> CommandLine::files() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace spoolflow::apps

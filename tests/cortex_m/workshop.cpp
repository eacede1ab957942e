#include "tests/cortex_m/workshop.hpp"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>

#include <fmt/format.h>

#include "spoolflow/export/cpp_folder.hpp"

namespace spoolflow::cortex_m {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

Workshop::Workshop(const model::Model& model) {
  std::string name = (fs::temp_directory_path() / "spoolflow-cortex-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
  folder_ = name;
  for (const exports::ExportedFile& file : exports::cpp_folder(model)) write(file.name, file.content);
}

Workshop::~Workshop() {
  fs::remove_all(folder_);
}

void Workshop::write(const std::string& name, const std::string& bytes) const {
  fs::create_directories((folder_ / name).parent_path());
  std::ofstream(folder_ / name, std::ios::binary) << bytes;
}

std::string Workshop::run(const std::string& command, int allowed_status) {
  const fs::path said = folder_ / "said";
  const int status =
      std::system(fmt::format("cd '{}' && {{ {} ; }} </dev/null >said 2>&1", folder_.string(), command).c_str());
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  if (status_ > allowed_status)
    throw std::runtime_error(fmt::format("{}\nfailed ({}): {}", command, status_, content(said)));
  return content(said);
}

void Workshop::read_lines(const std::string& command, const std::function<void(const std::string&)>& each) const {
  const std::unique_ptr<FILE, int (*)(FILE*)> out(
      ::popen(fmt::format("cd '{}' && {} </dev/null", folder_.string(), command).c_str(), "r"), ::pclose);
  if (!out) throw std::runtime_error("cannot run " + command);
  std::array<char, 512> text;
  std::string line;
  while (std::fgets(text.data(), static_cast<int>(text.size()), out.get()) != nullptr) {
    line += text.data();
    if (line.back() != '\n') continue;
    line.pop_back();
    each(line);
    line.clear();
  }
}

std::string options(const Core& core) {
  return fmt::format(
      " {} -mthumb -O2 -ffreestanding -ffunction-sections -fdata-sections "
      "-fno-tree-loop-distribute-patterns -Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Werror -I. -I{} ",
      core.flags, SPOOLFLOW_FIRMWARE);
}

std::string compiler(const Core& core) {
  return "arm-none-eabi-g++ -std=c++17 -fno-exceptions -fno-rtti -fno-threadsafe-statics" + options(core);
}

std::string c_compiler(const Core& core) {
  return "arm-none-eabi-gcc -std=c99" + options(core);
}

std::string link() {
  return fmt::format(" -nostartfiles -nostdlib -Wl,--gc-sections -T {}/board.ld ", SPOOLFLOW_FIRMWARE);
}

std::string emulator(const Core& core, const std::string& image) {
  return fmt::format(
      "qemu-system-arm -M {} -display none -serial none -monitor none -chardev stdio,id=c0 "
      "-semihosting-config enable=on,target=native,chardev=c0 -icount shift=6 -kernel {}",
      core.machine, image);
}

Figures figures_of(const std::string& printed) {
  Figures figures;
  std::istringstream lines(printed);
  for (std::string line; std::getline(lines, line);) {
    const auto space = line.rfind(' ');
    if (space == std::string::npos) throw std::runtime_error("the core said: " + printed);
    figures[line.substr(0, space)] = static_cast<std::uint32_t>(std::stoul(line.substr(space + 1)));
  }
  return figures;
}

}  // namespace spoolflow::cortex_m

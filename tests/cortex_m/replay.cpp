#include "tests/cortex_m/replay.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>

#include <fmt/format.h>

#include "spoolflow/export/cpp_folder.hpp"
#include "tests/cortex_m/packed_run.hpp"

namespace spoolflow::cortex_m {
namespace {

namespace fs = std::filesystem;
using estimation::Estimator;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The folder in which an export is built and run; it goes with the object.
class Workshop {
 public:
  explicit Workshop(const model::Model& model) {
    std::string name = (fs::temp_directory_path() / "spoolflow-cortex-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder");
    folder_ = name;
    for (const exports::ExportedFile& file : exports::cpp_folder(model)) write(file.name, file.content);
  }
  ~Workshop() { fs::remove_all(folder_); }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  void write(const std::string& name, const std::string& bytes) const {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  /// What the command prints. Throws where its exit status is not one of 0 to `allowed_status`.
  std::string run(const std::string& command, int allowed_status = 0) {
    const fs::path said = folder_ / "said";
    const int status =
        std::system(fmt::format("cd '{}' && {{ {} ; }} </dev/null >said 2>&1", folder_.string(), command).c_str());
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    if (status_ > allowed_status)
      throw std::runtime_error(fmt::format("{}\nfailed ({}): {}", command, status_, content(said)));
    return content(said);
  }
  [[nodiscard]] int status() const { return status_; }

 private:
  fs::path folder_;
  int status_ = 0;
};

std::string compiler(const Core& core) {
  return fmt::format(
      "arm-none-eabi-g++ {} -mthumb -mfloat-abi=hard -std=c++20 -O2 -ffreestanding -fno-exceptions -fno-rtti "
      "-fno-threadsafe-statics -ffunction-sections -fdata-sections -fno-tree-loop-distribute-patterns "
      "-Wall -Wextra -Wpedantic -Wconversion -Wdouble-promotion -Werror -I. -I{} ",
      core.flags, SPOOLFLOW_FIRMWARE);
}

/// -nostdlib: the sensor must not need any library but the compiler's own.
std::string link() {
  return fmt::format(" -nostartfiles -nostdlib -Wl,--gc-sections -T {}/board.ld ", SPOOLFLOW_FIRMWARE);
}

std::string emulator(const Core& core, const std::string& image) {
  return fmt::format(
      "qemu-system-arm -M {} -display none -serial none -monitor none -chardev stdio,id=c0 "
      "-semihosting-config enable=on,target=native,chardev=c0 -icount shift=6 -kernel {}",
      core.machine, image);
}

std::uint32_t flash_bytes(Workshop& workshop, const Core& core, const std::string& which) {
  workshop.run(compiler(core) + which +
               SPOOLFLOW_FIRMWARE
               "/sensor_image.cpp -o sensor.elf -nostartfiles -nostdlib "
               "-Wl,--gc-sections -Wl,-e,sensor_step -lgcc");
  std::istringstream sizes(workshop.run("arm-none-eabi-size sensor.elf | tail -1"));
  std::uint32_t text = 0, data = 0;
  if (!(sizes >> text >> data)) throw std::runtime_error("arm-none-eabi-size: no sizes");
  return text + data;
}

using Figures = std::map<std::string, std::uint32_t>;

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

StepCost cost(const Figures& figures, const std::string& name, const std::string& way) {
  return {way, figures.at(name + " steps"), figures.at(name + " median"), figures.at(name + " largest")};
}

/// The order of mode_of in firmware/sensor_under_test.hpp.
std::vector<std::string> ways(Estimator estimator) {
  if (estimator == Estimator::condensed) return {"sample missing", "closed", "open", "outside its map"};
  return {"sample missing", "rest",           "rest, block", "transient",     "transient, block",
          "opening",        "opening, block", "closing",     "closing, block"};
}

}  // namespace

Replay replay(const model::Model& model, Estimator estimator, const fs::path& recording, const Core& core) {
  Workshop workshop(model);
  workshop.write("run.bin", packed_run(model, estimator, recording));
  const std::string which = estimator == Estimator::condensed ? "-DREPLAY_CONDENSED " : "";
  workshop.run(compiler(core) + which +
               SPOOLFLOW_FIRMWARE "/board.cpp " SPOOLFLOW_FIRMWARE "/replay.cpp -o replay.elf" + link() + "-lgcc");
  const Figures figures = figures_of(workshop.run(emulator(core, "replay.elf")));
  if (figures.at("overflowing") > 0) throw std::runtime_error("a step took more instructions than the firmware counts");

  Replay out{};
  out.points = figures.at("points");
  out.largest_error_percent = 1e-4 * figures.at("error_ppm");
  out.not_a_number = figures.at("not_a_number");
  out.made_nan = (figures.at("flags_recorded") & 1U) != 0;
  out.met_denormal = (figures.at("flags") & 0x88U) != 0;
  out.statuses = static_cast<sensor::Status>(figures.at("statuses"));
  out.all = cost(figures, "all", "all");
  const std::vector<std::string> names = ways(estimator);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const StepCost way = cost(figures, fmt::format("mode{}", k), names[k]);
    if (way.steps > 0) out.ways.push_back(way);
  }
  out.state_bytes = figures.at("state_bytes");
  out.stack_bytes = figures.at("stack_bytes");
  out.flash_bytes = flash_bytes(workshop, core, which);
  workshop.run(compiler(core) + SPOOLFLOW_FIRMWARE "/board.cpp self_test.cpp -o self_test.elf" + link() + "-lgcc");
  workshop.run(emulator(core, "self_test.elf"), 3);
  out.self_test_status = static_cast<std::uint32_t>(workshop.status());
  return out;
}

}  // namespace spoolflow::cortex_m

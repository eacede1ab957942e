#pragma once
/// A folder in which firmware is built from an export and run on an emulated core.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "spoolflow/model/model.hpp"
#include "tests/cortex_m/replay.hpp"

namespace spoolflow::cortex_m {

/// Holds what `export cpp` writes of a model; it goes with the object.
class Workshop {
 public:
  explicit Workshop(const model::Model& model);
  ~Workshop();
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;

  void write(const std::string& name, const std::string& bytes) const;
  /// What the command prints. Throws std::runtime_error where its exit status is not one of 0 to `allowed_status`.
  std::string run(const std::string& command, int allowed_status = 0);
  [[nodiscard]] int status() const { return status_; }
  /// Calls `each` with every line that the command prints, while it runs.
  void read_lines(const std::string& command, const std::function<void(const std::string&)>& each) const;

 private:
  std::filesystem::path folder_;
  int status_ = 0;
};

/// The compiler with all that firmware is compiled with, to be followed by the sources; C++, and C99.
[[nodiscard]] std::string compiler(const Core& core);
[[nodiscard]] std::string c_compiler(const Core& core);
/// What both have in common.
[[nodiscard]] std::string options(const Core& core);
/// -nostdlib: the sensor must not need any library but the compiler's own.
[[nodiscard]] std::string link();
[[nodiscard]] std::string emulator(const Core& core, const std::string& image);

/// "NAME number" of each line that the firmware has printed.
using Figures = std::map<std::string, std::uint32_t>;
[[nodiscard]] Figures figures_of(const std::string& printed);

}  // namespace spoolflow::cortex_m

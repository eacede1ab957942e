#pragma once
#include <filesystem>
#include <string>

#include "spoolflow/export/cpp_folder.hpp"

namespace spoolflow::exports {

/// The model that calibration makes of examples/valve_a.
[[nodiscard]] model::Model example_model();
/// A whole valve that is the example's valve in both directions.
[[nodiscard]] model::Model whole_example_model();

/// A model's exported folder on disk; it goes with the object.
class ExportedFolder {
 public:
  explicit ExportedFolder(const model::Model& model);
  ~ExportedFolder();
  ExportedFolder(const ExportedFolder&) = delete;
  ExportedFolder& operator=(const ExportedFolder&) = delete;

  [[nodiscard]] std::string path() const { return folder_.string(); }
  [[nodiscard]] std::string content(const std::string& name) const;
  void write(const std::string& name, const std::string& content) const;
  /// Runs a command of the shell in the folder; returns its exit status. What it says goes to standard error.
  [[nodiscard]] int run(const std::string& command) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace spoolflow::exports

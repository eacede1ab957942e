#pragma once
/// Runs the built command as a user would, and keeps what it said.
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace spoolflow::apps {

struct Answer {
  int status;           ///< exit status, or 128 + the signal that ended it, as a shell reports it
  std::string output;   ///< standard output
  std::string message;  ///< standard error
};

/// `arguments` as a shell reads them, after the command's name: "estimate model.json run.csv -o - < run.csv".
[[nodiscard]] Answer spoolflow(const std::string& arguments);

/// A temporary folder in which the command runs and which goes with the test.
class CommandLine : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;

  /// Runs in the folder.
  [[nodiscard]] Answer run(const std::string& arguments) const;
  [[nodiscard]] std::string content(const std::filesystem::path& file) const;
  void write(const std::filesystem::path& file, const std::string& text) const;
  /// Names of the files in the folder, in order; a dot file that was left behind is among them.
  [[nodiscard]] std::vector<std::string> files() const;

  std::filesystem::path folder;
};

}  // namespace spoolflow::apps

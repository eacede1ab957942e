#pragma once
/// Every command of the core, one file each. A new one is declared here, defined in NAME_command.cpp and named in
/// commands.cpp; its callback does the work and throws where it cannot (std::invalid_argument: unusable input, status
/// 2; anything else: status 1; SeveralFailures: what went wrong with each of several inputs).
#include <exception>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace spoolflow::apps {

/// Failures of one command that goes on after each, every one reported as if it had come alone.
struct SeveralFailures : std::exception {
  std::vector<std::string> messages;
  bool of_the_work = false;  ///< one at least is no unusable input: exit status 1 instead of 2
  [[nodiscard]] const char* what() const noexcept override { return "several failures"; }
};

/// Throws all failures, one at least, as one, each reported as if it had come alone. A failure of the work weighs more
/// than an unusable input.
[[noreturn]] void throw_together(const std::vector<std::exception_ptr>& failures);

/// For `inspect`: prints what an image of parameters is, as JSON or for people. False where the file is none; standard
/// input and pipes are not asked. Throws std::invalid_argument where the sensor refuses it, after printing.
bool inspect_image(const std::string& file, bool json);

void add_demo_command(CLI::App& program);
void add_inspect_command(CLI::App& program);
void add_calibrate_command(CLI::App& program);
void add_estimate_command(CLI::App& program);
void add_validate_command(CLI::App& program);
void add_monitor_command(CLI::App& program);
void add_recalibrate_command(CLI::App& program);
void add_simulate_command(CLI::App& program);
void add_campaign_command(CLI::App& program);
void add_plan_command(CLI::App& program);
void add_analyse_command(CLI::App& program);
void add_export_command(CLI::App& program);
/// All of the above, in the order of the work, which is the order of the overview.
void add_core_commands(CLI::App& program);
/// Last: it knows the commands that were added before it.
void add_completion_command(CLI::App& program);

}  // namespace spoolflow::apps

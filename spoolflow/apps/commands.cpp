#include "spoolflow/apps/commands.hpp"

#include <stdexcept>

namespace spoolflow::apps {

void throw_together(const std::vector<std::exception_ptr>& failures) {
  if (failures.size() == 1) std::rethrow_exception(failures.front());
  SeveralFailures all;
  for (const std::exception_ptr& failure : failures) {
    try {
      std::rethrow_exception(failure);
    } catch (const std::exception& error) {
      all.messages.emplace_back(error.what());
      all.of_the_work = all.of_the_work || dynamic_cast<const std::invalid_argument*>(&error) == nullptr;
    }
  }
  throw all;
}

void add_core_commands(CLI::App& program) {
  add_demo_command(program);
  add_inspect_command(program);
  add_calibrate_command(program);
  add_estimate_command(program);
  add_validate_command(program);
  add_monitor_command(program);
  add_recalibrate_command(program);
  add_simulate_command(program);
  add_campaign_command(program);
  add_plan_command(program);
  add_analyse_command(program);
  add_export_command(program);
}

}  // namespace spoolflow::apps

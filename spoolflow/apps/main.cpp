/// The spoolflow command.
#include "spoolflow/apps/addon_programs.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/program.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"

namespace {

using namespace spoolflow::apps;

void add_commands(CLI::App& program) {
  add_core_commands(program);
  add_addon_commands(program);
  add_completion_command(program);
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_streams();
  if (const int status = run_addon_program(argc, argv); status >= 0) return status;
  return run_program(add_commands, argc, argv);
}

/// spoolflow-live: the commands of valves at work, which `spoolflow` finds beside itself.
#include "addons/live/program/live_commands.hpp"
#include "spoolflow/apps/program.hpp"

namespace {

using namespace spoolflow::apps;

void add_commands(CLI::App& program) {
  add_live_command(program);
  add_history_command(program);
  add_account_command(program);
}

}  // namespace

int main(int argc, char** argv) {
  return run_program(add_commands, argc, argv);
}

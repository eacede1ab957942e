/// spoolflow-fleet: the commands of a fleet, those of `spoolflow` with their work given to it, and those of `live` with
/// what sends samples to it. `spoolflow` finds it beside itself.
#include <memory>

#include "addons/fleet/pieces/work_by_fleet.hpp"
#include "addons/fleet/program/fleet_commands.hpp"
#include "addons/fleet/publisher.hpp"
#include "addons/live/engine.hpp"
#include "addons/live/program/live_commands.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/program.hpp"

namespace {

using namespace spoolflow;
using namespace spoolflow::apps;

void add_commands(CLI::App& program) {
  add_core_commands(program);
  add_live_command(program);
  add_history_command(program);
  add_account_command(program);
  add_worker_command(program);
  add_fleet_command(program);
}

}  // namespace

int main(int argc, char** argv) {
  give_work_to_fleets();
  publisher_maker() = [](live::Engine& engine, const std::function<void(const std::string&)>& report) {
    return std::make_shared<fleet::Publisher>(engine, report);
  };
  return run_program(add_commands, argc, argv);
}

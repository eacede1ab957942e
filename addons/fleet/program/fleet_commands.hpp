#pragma once
/// The commands of the add-on `fleet`.

namespace CLI {
class App;
}

namespace spoolflow::apps {

void add_worker_command(CLI::App& program);
void add_fleet_command(CLI::App& program);

}  // namespace spoolflow::apps

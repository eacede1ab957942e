#pragma once
/// Every command of the program, one file each. A new one is declared here, defined in NAME_command.cpp and named in
/// main.cpp; its callback does the work and throws where it cannot (std::invalid_argument: unusable input, status 2;
/// anything else: status 1).

namespace CLI {
class App;
}

namespace spoolflow::apps {

void add_demo_command(CLI::App& program);
void add_inspect_command(CLI::App& program);
void add_calibrate_command(CLI::App& program);
void add_estimate_command(CLI::App& program);
void add_validate_command(CLI::App& program);
void add_monitor_command(CLI::App& program);
void add_simulate_command(CLI::App& program);
void add_campaign_command(CLI::App& program);
void add_analyse_command(CLI::App& program);
void add_export_command(CLI::App& program);

}  // namespace spoolflow::apps

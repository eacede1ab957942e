#pragma once
/// A program with commands: `spoolflow` itself, and those of add-ons, which speak in its name.

namespace CLI {
class App;
}

namespace spoolflow::apps {

/// Parses the arguments, runs the command that they choose, and makes every failure one line on standard error. The
/// only place that catches what commands throw. Returns the exit status: 0 done, 1 the work failed, 2 wrong usage or
/// unusable input.
int run_program(void (*add_commands)(CLI::App&), int argc, char** argv);

}  // namespace spoolflow::apps

#pragma once
/// Commands that add-ons bring: `spoolflow` runs the add-on's program, which stands beside it, as git does.
#include <string_view>

namespace CLI {
class App;
}

namespace spoolflow::apps {

/// Where the arguments ask for a command of an add-on, or for work elsewhere (`--fleet`): replaces this process by the
/// add-on's program. Returns an exit status where that program is missing or cannot be started, after saying how to get
/// it; -1 where the arguments ask for nothing of the kind.
int run_addon_program(int argc, char** argv);

/// In the middle of a command that needs more than its own program has: the add-on's program does the command from its
/// beginning. The arguments are those of run_program(). Throws std::invalid_argument where that program is missing,
/// std::runtime_error where it cannot be started.
[[noreturn]] void go_on_as(std::string_view addon);
/// The arguments of this process, for go_on_as().
void keep_arguments(char** argv);

/// The overview names them, with the add-on each comes from.
void add_addon_commands(CLI::App& program);

}  // namespace spoolflow::apps

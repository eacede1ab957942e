#pragma once

namespace CLI {
class App;
}

namespace spoolflow::apps {

/// Gives the program's help, and that of every command added later, its form: arguments in capitals, required options
/// in the usage line, columns that fit.
void shape_help_page(CLI::App& program);

}  // namespace spoolflow::apps

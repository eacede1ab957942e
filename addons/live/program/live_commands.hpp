#pragma once
/// The commands of the add-on `live`; that of `fleet` has them, too, and gives them what sends samples to a fleet.
#include <functional>
#include <memory>
#include <string>

namespace CLI {
class App;
}
namespace spoolflow::live {
class Engine;
}

namespace spoolflow::apps {

void add_live_command(CLI::App& program);
void add_history_command(CLI::App& program);
void add_account_command(CLI::App& program);

/// Makes what sends an engine's samples to its fleet while it lives; `report` gets what is worth a line.
using PublisherMaker =
    std::function<std::shared_ptr<void>(live::Engine& engine, const std::function<void(const std::string&)>& report)>;
/// The program's own; empty in `spoolflow-live`, which hands such a site over to `spoolflow-fleet`.
[[nodiscard]] PublisherMaker& publisher_maker();

}  // namespace spoolflow::apps

#include "spoolflow/apps/addon_programs.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/terminal/terminal_text.hpp"

namespace spoolflow::apps {
namespace {

struct AddonCommand {
  std::string_view name;
  std::string_view addon;
  std::string_view purpose;  ///< empty: not in the overview
};

constexpr std::array<AddonCommand, 6> addon_commands{{
    {"live", "live", "show valves at work on a page, with condition and\nhistory"},
    {"history", "live", "write what a store of `spoolflow live` keeps of a valve"},
    {"account", "live", "make an account for the page of `spoolflow live`"},
    {"worker", "fleet", "work on valves of a fleet: take partitions,\nestimate, commit"},
    {"fleet", "fleet", "show a whole fleet on a page"},
    {"piece", "fleet", ""},  // what a worker starts; nobody types it
}};

char** kept_arguments = nullptr;

/// The add-on that the arguments ask for; empty: none.
std::string_view asked_for(int argc, char** argv) {
  if (argc < 2) return {};
  const std::string_view first = argv[1];
  if (first == "help" && argc > 2) return asked_for(argc - 1, argv + 1);
  for (const AddonCommand& command : addon_commands) {
    if (first == command.name) return command.addon;
  }
  for (int k = 2; k < argc; ++k) {
    const std::string_view word = argv[k];
    if (word == "--fleet" || word.starts_with("--fleet=")) return "fleet";
  }
  return {};
}

/// Beside this program, whatever name it was started by.
std::filesystem::path program_of(std::string_view addon) {
  std::error_code failure;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", failure);
  return own.parent_path() / fmt::format("spoolflow-{}", addon);
}

}  // namespace

void keep_arguments(char** argv) {
  kept_arguments = argv;
}

void go_on_as(std::string_view addon) {
  const std::filesystem::path program = program_of(addon);
  std::error_code failure;
  if (!std::filesystem::exists(program, failure)) {
    throw std::invalid_argument(fmt::format(
        "this belongs to the add-on '{}', whose program {} is not there; in the sources `./run {}` builds it", addon,
        program.string(), addon));
  }
  ::execv(program.c_str(), kept_arguments);
  throw std::runtime_error(fmt::format("{} cannot be started: {}", program.string(), std::strerror(errno)));
}

int run_addon_program(int argc, char** argv) {
  constexpr int work_failed = 1, wrong_usage = 2;
  const std::string_view addon = asked_for(argc, argv);
  if (addon.empty()) return -1;
  keep_arguments(argv);
  try {
    go_on_as(addon);
  } catch (const std::invalid_argument& error) {
    say("spoolflow {}: {}\n", argv[1], error.what());
    return wrong_usage;
  } catch (const std::exception& error) {
    say("spoolflow {}: {}\n", argv[1], error.what());
    return work_failed;
  }
}

void add_addon_commands(CLI::App& program) {
  for (const AddonCommand& command : addon_commands) {
    if (command.purpose.empty()) continue;
    program.add_subcommand(std::string(command.name), std::string(command.purpose))
        ->group(fmt::format("Commands of the add-on '{}'", command.addon));
  }
}

}  // namespace spoolflow::apps

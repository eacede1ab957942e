#include "spoolflow/apps/command.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace spoolflow::apps {
namespace {

std::string examples_heading(const CLI::App& program) {
  return program.get_footer().empty() ? "Examples:\n" : program.get_footer() + "\n";
}

}  // namespace

CLI::App* add_command(CLI::App& program, const CommandText& text) {
  CLI::App* command = program.add_subcommand(text.name, text.purpose);
  std::string footer = fmt::format("Reads:  {}\nWrites: {}\n\nExamples:", text.reads, text.writes);
  for (const std::string& example : text.examples) footer += "\n  " + example;
  command->footer(footer);
  if (!text.examples.empty()) program.footer(examples_heading(program) + "  " + text.examples.front());
  return command;
}

void add_quiet(CLI::App& command, bool& quiet) {
  command.add_flag("-q,--quiet", quiet, "no progress (it is shown on a terminal only)");
}

}  // namespace spoolflow::apps

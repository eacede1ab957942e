#include "spoolflow/apps/program.hpp"

#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/addon_programs.hpp"
#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/terminal/interruption.hpp"
#include "spoolflow/apps/terminal/output_file.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/recording/channels/allowed_names.hpp"

namespace spoolflow::apps {
namespace {

constexpr int done = 0, work_failed = 1, wrong_usage = 2;

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(program)) names.push_back(command->get_name());
  return names;
}

const CLI::App* chosen(const CLI::App& program) {
  const auto parsed = program.get_subcommands();
  return parsed.empty() ? nullptr : parsed.front();
}

std::string speaker(const CLI::App& program) {
  const CLI::App* command = chosen(program);
  return command == nullptr ? program.get_name() : program.get_name() + " " + command->get_name();
}

/// What was typed wrong, in one line that says what to do next.
std::string usage_message(const CLI::App& program, const CLI::ParseError& error) {
  const CLI::App* command = chosen(program);
  for (const std::string& word : program.remaining(true)) {
    if (word.size() > 1 && word.front() == '-') {
      const std::string name = word.substr(0, word.find('='));
      return fmt::format("there is no option {}{}", name,
                         recording::did_you_mean(name, option_names(command ? *command : program)));
    }
    if (command == nullptr) {
      return fmt::format("there is no command '{}'{}", word, recording::did_you_mean(word, command_names(program)));
    }
    return fmt::format("one argument too many: {}", word);
  }
  return error.what();
}

/// Else an option from a shell variable without a value would be as good as not given.
void refuse_empty_words(const CLI::App& program) {
  const CLI::App* command = chosen(program);
  if (command == nullptr) return;
  for (const CLI::Option* option : command->get_options()) {
    if (std::ranges::count(option->results(), "") == 0) continue;
    throw CLI::ValidationError(option->get_name(),
                               "is an empty word, as of a shell variable without a value; give one, or leave it out");
  }
}

int help_or_refuse(const CLI::App& program, const CLI::ParseError& error) {
  if (error.get_exit_code() == done) {
    OutputFile output("-");
    const CLI::App* command = chosen(program);
    if (dynamic_cast<const CLI::CallForVersion*>(&error) != nullptr) {
      output.stream() << program.get_name() << ' ' << tool_version() << '\n';
    } else {
      output.stream() << (command ? command->help(program.get_name()) : program.help());
    }
    output.commit();
    return done;
  }
  say("{}: {}; see {} --help\n", speaker(program), usage_message(program, error), speaker(program));
  return wrong_usage;
}

/// `spoolflow help calibrate` is `spoolflow calibrate --help`; CLI11 takes arguments from the back.
std::vector<std::string> arguments_of(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    words.emplace_back("--help");
  }
  std::ranges::reverse(words);
  return words;
}

int run(CLI::App& program, int argc, char** argv) {
  try {
    program.parse(arguments_of(argc, argv));
    if (chosen(program) != nullptr) {
      flush_standard_output();
      return done;
    }
    say("{0}: no command given; see {0} --help\n", program.get_name());
    return wrong_usage;
  } catch (const CLI::ParseError& error) {
    return help_or_refuse(program, error);
  }
}

/// Ends as a program does on the signal of a closed pipe: silently.
[[noreturn]] void end_by_sigpipe() {
  std::signal(SIGPIPE, SIG_DFL);
  std::raise(SIGPIPE);
  std::_Exit(work_failed);
}

/// Every failure becomes one line and an exit status.
int run_and_report(void (*add_commands)(CLI::App&), int argc, char** argv) {
  CLI::App program("Soft flow-rate sensor for solenoid-operated spool valves: from rig recordings to a flow rate.",
                   "spoolflow");
  shape_help_page(program);
  program.set_version_flag("--version", std::string(tool_version()), "print the version");
  program.require_subcommand(0, 1);
  program.parse_complete_callback([&program] {
    interruption_speaker(speaker(program));
    refuse_empty_words(program);
  });
  add_commands(program);
  const auto report = [&program](const std::string& message) { say("{}: {}\n", speaker(program), message); };
  try {
    return run(program, argc, argv);
  } catch (const ReaderGone&) {
    end_by_sigpipe();
  } catch (const SeveralFailures& failures) {
    for (const std::string& message : failures.messages) report(message);
    return failures.of_the_work ? work_failed : wrong_usage;
  } catch (const std::invalid_argument& error) {
    report(error.what());
    return wrong_usage;
  } catch (const std::filesystem::filesystem_error& error) {  // a name that leads nowhere, such as a loop of links
    report(fmt::format("{}: {}", error.path1().string(), error.code().message()));
    return wrong_usage;
  } catch (const std::bad_alloc&) {
    report("out of memory; try a shorter recording or a machine with more");
    return work_failed;
  } catch (const std::exception& error) {
    report(error.what());
    return work_failed;
  }
}

}  // namespace

int run_program(void (*add_commands)(CLI::App&), int argc, char** argv) {
  hold_standard_streams();
  keep_arguments(argv);
  try {
    end_cleanly_when_interrupted("spoolflow");
    return run_and_report(add_commands, argc, argv);
  } catch (...) {
    std::fputs("spoolflow: a failure that could not be reported\n", stderr);
    return work_failed;
  }
}

}  // namespace spoolflow::apps

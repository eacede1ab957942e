#include "spoolflow/apps/command.hpp"

#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/report/text/reader_units.hpp"

namespace spoolflow::apps {
namespace {

constexpr std::size_t help_columns = 96;

/// "Reads:   …" with the text broken at spaces and the further lines indented below the first.
std::string paragraph(const std::string& heading, const std::string& text) {
  constexpr std::size_t indent = 9;
  std::string out = fmt::format("{:<{}}", heading, indent);
  std::size_t column = indent;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (column > indent && column + 1 + word.size() > help_columns) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    }
    if (column > indent) out += ' ', ++column;
    out += word;
    column += word.size();
  }
  return out + "\n";
}

std::string examples_heading(const CLI::App& program) {
  return program.get_footer().empty() ? "Examples:\n" : program.get_footer() + "\n";
}

class HelpPage : public CLI::Formatter {
 public:
  HelpPage() {
    column_width(26);
    label("SUBCOMMAND", "COMMAND");
    label("REQUIRED", "");
    label("Positionals", "Arguments");
  }

  std::string make_usage(const CLI::App* app, std::string name) const override {
    std::string usage = fmt::format("\nUsage: {}", name);
    for (const CLI::Option* option : app->get_options([](const CLI::Option* o) { return o->get_positional(); })) {
      usage += " " + make_option_usage(option);
    }
    for (const CLI::Option* option : app->get_options([](const CLI::Option* o) { return o->nonpositional(); })) {
      if (option->get_required()) usage += fmt::format(" {} {}", shortest_name(option), option->get_type_name());
    }
    if (!app->get_subcommands({}).empty()) usage += " COMMAND …";
    return usage + " [OPTIONS]\n";
  }

  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    const std::string name = CLI::Formatter::make_option_name(option, is_positional);
    return is_positional ? upper_case(name) : name;
  }

  std::string make_option_opts(const CLI::Option* option) const override {
    if (option->get_positional()) return {};
    std::string text = CLI::Formatter::make_option_opts(option);
    const std::string value = option->get_default_str();
    const std::string in_brackets = " [" + value + "] ";  // by newer versions of CLI11; by older ones =value
    if (const auto at = text.find(in_brackets); !value.empty() && at != std::string::npos) {
      text.replace(at, in_brackets.size(), "=" + value);
    }
    while (text.ends_with(' ')) text.pop_back();
    return text;
  }

 private:
  static std::string shortest_name(const CLI::Option* option) {
    return option->get_snames().empty() ? "--" + option->get_lnames().front() : "-" + option->get_snames().front();
  }
  static std::string upper_case(std::string text) {
    for (char& letter : text) {
      if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    }
    return text;
  }
};

// What a shell completes.

std::string options_of(const CLI::App& command) {
  return fmt::format("{}", fmt::join(option_names(command), " "));
}

/// Commands first, then options behind a dash, else files; the same for both shells.
std::string bash_text(const CLI::App& program) {
  std::string commands = "help", cases;
  for (const CLI::App* command : commands_of(program)) {
    commands += " " + command->get_name();
    cases += fmt::format("    {}) options=\"{}\" ;;\n", command->get_name(), options_of(*command));
  }
  return "_spoolflow() {\n  local word=\"${COMP_WORDS[COMP_CWORD]}\" options=\"" + options_of(program) +
         "\" commands=\"" + commands + "\"\n  COMPREPLY=()\n  if [ \"$COMP_CWORD\" -gt 1 ]; then\n    " +
         "case \"${COMP_WORDS[1]}\" in\n"
         "    help) COMPREPLY=($(compgen -W \"$commands\" -- \"$word\")); return ;;\n"
         "    completion) commands=\"bash zsh fish\" options=--help ;;\n" +
         cases +
         "    esac\n"
         "    [ \"${COMP_WORDS[1]}\" = completion ] || commands=\"\"\n  fi\n"
         "  case \"$word\" in\n    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
         "    *) COMPREPLY=($(compgen -W \"$commands\" -- \"$word\")) ;;\n  esac\n}\n"
         "complete -o default -F _spoolflow spoolflow\n";
}

std::string in_quotes(std::string text) {
  for (std::size_t at = text.find_first_of("'\\"); at != std::string::npos; at = text.find_first_of("'\\", at + 2))
    text.insert(at, 1, '\\');
  return "'" + text.substr(0, text.find('\n')) + "'";
}

std::string fish_text(const CLI::App& program) {
  std::string out;
  for (const CLI::App* command : commands_of(program)) {
    out += fmt::format("complete -c spoolflow -n __fish_use_subcommand -f -a {} -d {}\n", command->get_name(),
                       in_quotes(command->get_description()));
    for (const CLI::Option* option : command->get_options()) {
      if (option->get_lnames().empty()) continue;
      out += fmt::format("complete -c spoolflow -n '__fish_seen_subcommand_from {}' -l {}", command->get_name(),
                         option->get_lnames().front());
      if (!option->get_snames().empty()) out += " -s " + option->get_snames().front();
      if (option->get_items_expected_max() > 0) out += " -r";
      out += fmt::format(" -d {}\n", in_quotes(option->get_description()));
    }
  }
  return out + "complete -c spoolflow -n '__fish_seen_subcommand_from completion' -f -a 'bash zsh fish'\n";
}

}  // namespace

std::vector<const CLI::App*> commands_of(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

void shape_help_page(CLI::App& program) {
  program.formatter(std::make_shared<HelpPage>());
  program.set_help_flag("-h,--help", "print this help; COMMAND --help explains a command");
}

CLI::App* add_command(CLI::App& program, const CommandText& text) {
  CLI::App* command = program.add_subcommand(text.name, text.purpose)->group("Commands");
  command->set_help_flag("-h,--help", "print this help");
  std::string footer = paragraph("Reads:", text.reads) + paragraph("Writes:", text.writes) + "\nExamples:";
  for (const std::string& example : text.examples) footer += "\n  " + example;
  command->footer(footer);
  if (!text.examples.empty()) program.footer(examples_heading(program) + "  " + text.examples.front());
  return command;
}

CLI::Validator between(double lowest, double highest) {
  const CLI::Range range(lowest, highest);
  return CLI::Validator(
      [range](std::string& text) {
        double value{};
        const bool no_number = !CLI::detail::lexical_cast(text, value) || std::isnan(value);
        return no_number ? "Value " + text + " is no number" : range(text);
      },
      range.get_description());
}

CLI::Validator whole_number_from(std::uint64_t lowest) {
  return CLI::Validator(
      [lowest](std::string& text) {
        std::uint64_t value{};
        const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
        if (digits && CLI::detail::lexical_cast(text, value) && value >= lowest) return std::string();
        return fmt::format("Value {} is no whole number from {} on", text, lowest);
      },
      "");
}

void add_quiet(CLI::App& command, bool& quiet) {
  command.add_flag("-q,--quiet", quiet, "no progress (it is shown on a terminal only)");
}

CLI::Option* add_fleet_option(CLI::App& command, std::string& fleet, const std::string& which) {
  return command.add_option("--fleet", fleet, "workers of a fleet do the work " + which + "; the result is the same")
      ->type_name("FLEET.toml");
}

void add_channels_option(CLI::App& command, std::string& channels) {
  command.add_option("--channels", channels, "channel map (TOML) for files with other column names or units")
      ->type_name("MAP.toml");
}

recording::ChannelMap channels_from(const std::string& file) {
  return file.empty() ? recording::ChannelMap() : recording::read_channel_map(file);
}

CLI::Option* add_environment_option(CLI::App& command, std::string& environment) {
  return command
      .add_option("--environment", environment,
                  "what the machine leaves open, for the band:\n"
                  "bench, machine, or a TOML file with [environment];\nthe model's own where not given")
      ->type_name("NAME|FILE.toml");
}

void add_units(CLI::App& command, std::vector<std::string>& units) {
  // One word: a list would swallow the arguments behind it.
  const auto split = [&units](const std::string& list) {
    std::istringstream rest(list);
    for (std::string name; std::getline(rest, name, ',');) units.push_back(name);
  };
  command
      .add_option_function<std::string>("--units", split,
                                        "units of the report, with commas between:\n" + report::choice_of_units())
      ->type_name("UNITS");
}

void add_completion_command(CLI::App& program) {
  auto shell = std::make_shared<std::string>();
  CLI::App* command =
      add_command(program, {"completion",
                            "print what a shell needs to complete commands and options",
                            "nothing",
                            "on standard output: a script for the shell, to be evaluated in it; nothing is installed",
                            {"spoolflow completion fish | source", "eval \"$(spoolflow completion bash)\""}});
  command->add_option("shell", *shell, "bash, zsh or fish")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->callback([shell, &program] {
    if (*shell == "zsh") print_text("autoload -Uz compinit bashcompinit && compinit && bashcompinit\n");
    print_text(*shell == "fish" ? fish_text(program) : bash_text(program));
  });
}

}  // namespace spoolflow::apps

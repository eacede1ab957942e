#include "spoolflow/apps/command.hpp"

#include <memory>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

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

}  // namespace

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

void add_quiet(CLI::App& command, bool& quiet) {
  command.add_flag("-q,--quiet", quiet, "no progress (it is shown on a terminal only)");
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

}  // namespace spoolflow::apps

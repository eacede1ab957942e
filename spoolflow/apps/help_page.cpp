#include "spoolflow/apps/help_page.hpp"

#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace spoolflow::apps {
namespace {

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

}  // namespace spoolflow::apps

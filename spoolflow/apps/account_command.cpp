/// `spoolflow account`: an account for the page of `spoolflow live`, with its password or token as a hash.
#include <cctype>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <termios.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/terminal_text.hpp"
#include "spoolflow/live/page/secret_hash.hpp"

namespace spoolflow::apps {
namespace {

constexpr std::size_t shortest_password = 10, longest_password = 256, longest_account_name = 32;

struct AccountArguments {
  std::string name;
  std::string role = "read";
  bool token = false;
};

/// As long as it lives the terminal shows nothing of what is typed.
class NoEcho {
 public:
  NoEcho() {
    if (::tcgetattr(STDIN_FILENO, &before_) != 0) return;
    termios silent = before_;
    silent.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    changed_ = ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent) == 0;
  }
  ~NoEcho() {
    if (changed_) ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
  }
  NoEcho(const NoEcho&) = delete;
  NoEcho& operator=(const NoEcho&) = delete;

 private:
  termios before_{};
  bool changed_ = false;
};

std::string line_of_input() {
  std::string line;
  if (!std::getline(std::cin, line)) throw std::invalid_argument("no password came in; it is read from standard input");
  return line;
}

std::string typed(const char* question) {
  say("{}", question);
  std::string line;
  {
    const NoEcho silence;
    line = line_of_input();
  }
  say("\n");
  return line;
}

std::string asked_password() {
  const bool terminal = ::isatty(STDIN_FILENO) != 0;
  std::string password = terminal ? typed("password (it is not shown): ") : line_of_input();
  if (password.size() < shortest_password || password.size() > longest_password) {
    throw std::invalid_argument(fmt::format("the password has {} bytes; it must have {} to {}", password.size(),
                                            shortest_password, longest_password));
  }
  if (terminal && typed("once more: ") != password) throw std::invalid_argument("the two passwords differ; try again");
  return password;
}

void account_command(const AccountArguments& arguments) {
  if (arguments.role != "read" && arguments.role != "acknowledge") {
    throw std::invalid_argument(fmt::format("--role is read or acknowledge, not '{}'", arguments.role));
  }
  bool plain = !arguments.name.empty() && arguments.name.size() <= longest_account_name;
  for (const char c : arguments.name) {
    plain = plain && (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-');
  }
  if (!plain) {
    throw std::invalid_argument(fmt::format("the name '{}' must be 1 to {} letters, digits, '_' and '-'",
                                            arguments.name, longest_account_name));
  }
  const std::string secret = arguments.token ? live::random_token() : asked_password();
  if (arguments.token) say("token, shown this once: {}.{}\n", arguments.name, secret);
  print("[[page.account]]\nname = \"{}\"\nrole = \"{}\"\nsecret = \"{}\"\n", arguments.name, arguments.role,
        live::secret_hash(secret));
}

}  // namespace

void add_account_command(CLI::App& program) {
  auto arguments = std::make_shared<AccountArguments>();
  CLI::App* command = add_command(
      program, {"account",
                "make an account for the page of `spoolflow live`",
                "a password of at least 10 bytes: typed, or the first line of standard input; with --token nothing",
                "lines for the site's file, with a hash (scrypt) of the password or token; the token goes to\n"
                "         standard error",
                {"spoolflow account anna --role acknowledge >> site.toml",
                 "spoolflow account prometheus --token >> site.toml"}});
  command->add_option("name", arguments->name, "1 to 32 letters, digits, _ and -")->type_name("NAME")->required();
  command->add_option("--role", arguments->role, "what it may do: read, or acknowledge alarms,\ntoo")
      ->type_name("read|acknowledge")
      ->capture_default_str();
  command->add_flag("--token", arguments->token, "a token of 256 random bits for a program instead\nof a password");
  command->callback([arguments] { account_command(*arguments); });
}

}  // namespace spoolflow::apps

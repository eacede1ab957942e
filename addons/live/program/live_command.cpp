/// `spoolflow live`: valves at work, watched until the program is ended; `spoolflow account`: who may see its page.
#include <cctype>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <termios.h>
#include <unistd.h>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "addons/live/engine.hpp"
#include "addons/live/fieldbus/fieldbus_outputs.hpp"
#include "addons/live/http/secret_hash.hpp"
#include "addons/live/http/server.hpp"
#include "addons/live/notify/notifier.hpp"
#include "addons/live/page/answer.hpp"
#include "addons/live/page/plotjuggler.hpp"
#include "addons/live/program/live_commands.hpp"
#include "addons/live/sources/socket.hpp"
#include "addons/live/valve/utc_text.hpp"
#include "spoolflow/apps/addon_programs.hpp"
#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/terminal/interruption.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/recording/open_table.hpp"

namespace spoolflow::apps {
namespace {

struct LiveArguments {
  std::string site;
  std::string listen;
  std::string store;
  std::string publish;
};

std::vector<std::filesystem::path> replayed_recordings(const live::SiteSettings& site) {
  std::vector<std::filesystem::path> files;
  for (const live::ValveSettings& valve : site.valves) {
    if (const auto* replay = std::get_if<live::ReplaySettings>(&valve.source)) files.push_back(replay->recording);
  }
  return files;
}

void report_addresses(const live::Engine& engine, const live::PageSettings& page) {
  for (std::size_t k = 0; k < engine.size(); ++k) {
    const live::SourceView source = engine.source(k);
    const auto* tcp = std::get_if<live::TcpSettings>(&engine.site().valves[k].source);
    if (tcp == nullptr) continue;
    say("valve {}: CSV over TCP at {}\n", engine.valve(k).id(), live::Address{tcp->listen.host, source.port}.text());
  }
  if (engine.site().udp) {
    say("datagrams over UDP at {}\n", live::Address{engine.site().udp->host, engine.udp_port()}.text());
  }
  if (engine.site().store.empty()) say("nothing is kept: name a file with --store\n");
  say("{} valve{}; page at {}://{}/ ; end with Ctrl-C\n", engine.size(), engine.size() == 1 ? "" : "s",
      page.has_tls() ? "https" : "http", page.listen.text());
}

/// What the fleet gets is kept until it has it, under a name that it knows.
void check_publishing(const live::SiteSettings& site) {
  if (site.fleet.servers.empty()) return;
  if (site.store.empty()) {
    throw std::invalid_argument(
        "--publish needs a store, which keeps what the fleet has not got yet: name a file with --store");
  }
  if (site.fleet.site.empty()) {
    throw std::invalid_argument(
        "--publish needs the site's name: write site = \"hall_3\" under [fleet] in the site's file (docs/fleet.md)");
  }
}

/// A store is made where its site can begin: not for one whose page or sources find their port in use.
void check_ports(const live::SiteSettings& site) {
  if (site.store.empty() || std::filesystem::exists(site.store)) return;
  (void)live::bind_socket(site.page.listen, live::Transport::tcp);
  if (site.udp) (void)live::bind_socket(*site.udp, live::Transport::udp);
  for (const live::ValveSettings& valve : site.valves) {
    if (const auto* tcp = std::get_if<live::TcpSettings>(&valve.source))
      (void)live::bind_socket(tcp->listen, live::Transport::tcp);
  }
}

/// What an end loses whose last second could not be kept.
std::string unkept_text(const live::StoreView& store) {
  const std::string since = store.kept_ms == 0 ? "the start" : live::utc(store.kept_ms);
  return fmt::format("ended; what came since {} could not be kept and is lost: {}", since, store.trouble);
}

void live_command(const LiveArguments& arguments) {
  live::SiteSettings site = arguments.site.empty() ? live::demo_site() : live::read_site(arguments.site);
  if (!arguments.listen.empty()) site.page.listen = live::read_address(arguments.listen, "--listen");
  if (!arguments.store.empty()) site.store = arguments.store;
  if (!arguments.publish.empty()) site.fleet.servers = live::read_servers(arguments.publish, "--publish");
  check_publishing(site);
  live::check_built_in(site);
  if (!site.fleet.servers.empty() && !publisher_maker()) go_on_as("fleet");
  live::PageSettings page = site.page;
  live::check_reach(page);
  check_ports(site);
  const InterruptionPause held_back;  // in this thread, and in all that it starts
  const auto fork_server = recording::fork_server_for(replayed_recordings(site));
  live::Engine engine(std::move(site), fmt::format("spoolflow {}", tool_version()));
  engine.report_by([](const std::string& text) { say("{}\n", text); });
  {
    const live::Notifier notifier(engine);  // before the start: alarms from then on are news
    engine.start();
    const live::PageServer server(site_page(engine), page,
                                  {arguments.site, [&](const std::string& text) { engine.note(text); }});
    std::optional<live::PlotJuggler> plotjuggler;
    if (engine.site().plotjuggler) plotjuggler.emplace(engine, *engine.site().plotjuggler);
    const live::FieldbusOutputs fieldbus(engine);
    for (const std::string& one : fieldbus.where()) say("{}\n", one);
    page.listen.port = server.port();
    report_addresses(engine, page);
    std::shared_ptr<void> publisher;
    if (!engine.site().fleet.servers.empty()) {
      publisher = publisher_maker()(engine, [](const std::string& text) { say("{}\n", text); });
    }
    wait_for_the_end();
  }
  engine.stop();
  const live::StoreView kept = engine.store_view();
  if (!kept.trouble.empty()) throw std::runtime_error(unkept_text(kept));
  say("ended; {}\n", engine.site().store.empty() ? "nothing was kept" : "what came until now is kept");
}

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
    const InterruptionPause held_back;  // or the terminal would stay silent
    const NoEcho silence;
    line = line_of_input();
  }
  say("\n");
  return line;
}

std::string asked_password() {
  const bool is_terminal = ::isatty(STDIN_FILENO) != 0;
  std::string password = is_terminal ? typed("password (it is not shown): ") : line_of_input();
  if (password.size() < shortest_password || password.size() > longest_password) {
    throw std::invalid_argument(fmt::format("the password has {} bytes; it must have {} to {}", password.size(),
                                            shortest_password, longest_password));
  }
  if (is_terminal && typed("once more: ") != password)
    throw std::invalid_argument("the two passwords differ; try again");
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

PublisherMaker& publisher_maker() {
  static PublisherMaker of_the_program;
  return of_the_program;
}

void add_live_command(CLI::App& program) {
  auto arguments = std::make_shared<LiveArguments>();
  CLI::App* command = add_command(
      program,
      {"live",
       "watch valves at work: flow, condition and events on a page",
       "SITE.toml, which names valves, their models and where their samples come from (docs/live.md): datagrams, "
       "connections, pipes, recordings; without it eight valves of the virtual rig, three of which age fast",
       "a page at http://127.0.0.1:8080 with an interface for other programs, until it is ended; with a store "
       "an SQLite file from which `spoolflow history` reads",
       {"spoolflow live", "spoolflow live site.toml --store site.sqlite",
        "spoolflow live site.toml --listen 127.0.0.1:9000"}});
  command->add_option("site", arguments->site, "site file; without it the demonstration")->type_name("SITE.toml");
  command
      ->add_option("--listen", arguments->listen,
                   "where the page is, instead of 127.0.0.1:8080 or\nwhat the site says; port 0: any that is free")
      ->type_name("ADDRESS:PORT");
  command->add_option("--store", arguments->store, "file that keeps history and state, made where\nthere is none")
      ->type_name("FILE.sqlite");
  command
      ->add_option("--publish", arguments->publish,
                   "NATS servers of a fleet that gets the samples,\nsuch as nats://a,b,c (docs/fleet.md)")
      ->type_name("SERVERS");
  command->callback([arguments] { live_command(*arguments); });
}

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

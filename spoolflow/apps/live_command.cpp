/// `spoolflow live`: valves at work, watched until the program is ended.
#include <csignal>
#include <memory>
#include <optional>
#include <pthread.h>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/commands.hpp"
#include "spoolflow/apps/interruption.hpp"
#include "spoolflow/apps/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"
#include "spoolflow/live/engine.hpp"
#include "spoolflow/live/page/plotjuggler.hpp"
#include "spoolflow/live/page/server.hpp"

namespace spoolflow::apps {
namespace {

struct LiveArguments {
  std::string site;
  std::string listen;
  std::string store;
};

/// The signal that ended the wait. They must be blocked in every thread.
int wait_for_the_end() {
  sigset_t ends;
  sigemptyset(&ends);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ends, number);
  int number = 0;
  sigwait(&ends, &number);
  return number;
}

void tell_where(const live::Engine& engine, const live::PageSettings& page) {
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
  say("{} valves; page at {}://{}/ ; end with Ctrl-C\n", engine.size(), page.has_tls() ? "https" : "http",
      page.listen.text());
}

void live_command(const LiveArguments& arguments) {
  live::SiteSettings site = arguments.site.empty() ? live::demo_site() : live::read_site(arguments.site);
  if (!arguments.listen.empty()) site.page.listen = live::read_address(arguments.listen, "--listen");
  if (!arguments.store.empty()) site.store = arguments.store;
  live::PageSettings page = site.page;
  live::check_reach(page);
  const InterruptionPause held_back;  // in this thread, and in all that it starts
  live::Engine engine(std::move(site), fmt::format("spoolflow {}", tool_version()));
  engine.start();
  {
    const live::PageServer server(engine, page);
    std::optional<live::PlotJuggler> plotjuggler;
    if (engine.site().plotjuggler) plotjuggler.emplace(engine, *engine.site().plotjuggler);
    page.listen.port = server.port();
    tell_where(engine, page);
    wait_for_the_end();
  }
  engine.stop();
  say("ended; {}\n", engine.site().store.empty() ? "nothing was kept" : "what came until now is kept");
}

}  // namespace

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
  command->callback([arguments] { live_command(*arguments); });
}

}  // namespace spoolflow::apps

/// `spoolflow worker`: takes its share of the fleet's valves; `spoolflow fleet`: shows the whole fleet on a page,
/// makes its tables and streams, and reports its state.
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "addons/fleet/jobs/job_worker.hpp"
#include "addons/fleet/jobs/piece_process.hpp"
#include "addons/fleet/page/fleet_page.hpp"
#include "addons/fleet/pieces/piece_kinds.hpp"
#include "addons/fleet/program/fleet_commands.hpp"
#include "addons/fleet/server_configuration.hpp"
#include "addons/fleet/worker.hpp"
#include "addons/live/http/server.hpp"
#include "spoolflow/apps/command.hpp"
#include "spoolflow/apps/terminal/interruption.hpp"
#include "spoolflow/apps/terminal/terminal_text.hpp"
#include "spoolflow/apps/tool_version.hpp"

namespace spoolflow::apps {
namespace {

struct FleetArguments {
  std::string fleet;
  std::string listen;
  bool setup = false, status = false;
};

/// The servers may need a moment to let a new client in.
bool wait_for(const fleet::Connection& nats) {
  constexpr std::chrono::milliseconds step{50};
  constexpr int steps = 60;
  for (int k = 0; k < steps && !nats.connected(); ++k) std::this_thread::sleep_for(step);
  return nats.connected();
}

fleet::SharedSettings shared_settings(const fleet::FleetSettings& settings) {
  return {fleet::partition_count, settings.raised_after_s, settings.gone_after_s};
}

void setup(const fleet::FleetSettings& settings) {
  fleet::Session session(settings.connection, "spoolflow fleet");
  const fleet::SchemaWork work = fleet::make_schema(session, shared_settings(settings));
  say("PostgreSQL: the tables {}\n", work == fleet::SchemaWork::made       ? "are made"
                                     : work == fleet::SchemaWork::upgraded ? "are brought to the present version"
                                                                           : "were there");
  fleet::Connection nats(fleet::access_of(settings.servers, settings.login), "spoolflow fleet");
  if (wait_for(nats)) {
    (void)nats.make_stream(settings.stream);
    say("NATS: the stream {} is there\n", settings.stream.name);
  } else {
    say("NATS: no server can be reached, or none lets this user in; the first worker makes the stream\n");
  }
  print_text(fleet::nats_configuration(settings) + "\n" + fleet::postgresql_configuration());
}

/// Of servers that choose a leader an answer takes a while.
std::string stream_text(fleet::Connection& nats, const std::string& name) {
  constexpr int tries = 5;
  constexpr std::chrono::milliseconds pause{500};
  for (int k = 1;; ++k) {
    try {
      const auto stream = nats.stream(name);
      return stream ? fmt::format("{} blocks, {:.1f} MB", stream->messages, 1e-6 * static_cast<double>(stream->bytes))
                    : "there is none; a worker makes it within seconds";
    } catch (const fleet::TransportError& error) {
      if (k == tries) return error.what();
    }
    std::this_thread::sleep_for(pause);
  }
}

void status(const fleet::FleetSettings& settings) {
  fleet::Session session(settings.connection, "spoolflow fleet");
  (void)fleet::read_settings(session);
  print("{:>9}  {:>6}  {:>7}  {:>10}  {:>8}  {}\n", "partition", "epoch", "valves", "blocks", "behind_s", "owner");
  std::int64_t set_aside = 0;
  for (const fleet::PartitionStatus& one : fleet::partition_status(session)) {
    set_aside += one.set_aside;
    const std::string behind = one.valves == 0 ? "-" : fmt::format("{:.1f}", one.behind_s);
    print("{:>9}  {:>6}  {:>7}  {:>10}  {:>8}  {}\n", one.number, one.epoch, one.valves, one.blocks, behind,
          one.owner.empty() || one.lease_s <= 0 ? "(nobody)" : one.owner);
  }
  if (set_aside > 0) print("{} blocks are set aside; see the table set_aside\n", set_aside);
  const fleet::JobStatus jobs = fleet::job_status(session);
  print("jobs: {} open, {} running, {} done, {} failed, {} given up; {} files, {:.1f} MB\n", jobs.open, jobs.running,
        jobs.done, jobs.failed, jobs.given_up, jobs.contents, jobs.contents_MB);
  fleet::Connection nats(fleet::access_of(settings.servers, settings.login), "spoolflow fleet");
  if (!wait_for(nats)) {
    print("NATS: no server can be reached\n");
    return;
  }
  print("stream {}: {}\n", settings.stream.name, stream_text(nats, settings.stream.name));
}

void serve(fleet::FleetSettings settings, const std::string& file, const std::string& listen) {
  if (!listen.empty()) settings.page.listen = live::read_address(listen, "--listen");
  live::PageSettings page = settings.page;
  live::check_reach(page);
  const InterruptionPause held_back;  // in this thread, and in all that it starts
  fleet::FleetPage fleet(settings);
  {
    const live::PageServer server(fleet.content(), page, {file, [](const std::string& text) { say("{}\n", text); }});
    page.listen.port = server.port();
    say("page at {}://{}/ ; end with Ctrl-C\n", page.has_tls() ? "https" : "http", page.listen.text());
    wait_for_the_end();
  }
  say("ended\n");
}

void fleet_command(const FleetArguments& arguments) {
  if (arguments.setup && arguments.status) throw std::invalid_argument("name one of --setup and --status");
  if ((arguments.setup || arguments.status) && !arguments.listen.empty())
    throw std::invalid_argument("--listen is for the page, which --setup and --status do not open");
  fleet::FleetSettings settings = fleet::read_fleet(arguments.fleet);
  if (arguments.setup) {
    setup(settings);
  } else if (arguments.status) {
    status(settings);
  } else {
    serve(std::move(settings), arguments.fleet, arguments.listen);
  }
}

void worker_command(const FleetArguments& arguments) {
  fleet::FleetSettings settings = fleet::read_fleet(arguments.fleet);
  const InterruptionPause held_back;  // in this thread, and in all that it starts
  {
    const auto report = [](const std::string& text) { say("{}\n", text); };
    fleet::JobWorkerParts parts{.connection = settings.connection, .owner = {}, .program = {}};
    parts.lease_s = settings.worker.lease_s;
    parts.settings = settings.jobs;
    parts.write = write_piece_file;
    fleet::Worker worker(std::move(settings), fmt::format("spoolflow {}", tool_version()), report);
    parts.owner = worker.owner();
    parts.program = fleet::piece_program(std::string(tool_version()));
    say("worker {}; end with Ctrl-C\n", worker.owner());
    fleet::JobWorker jobs(std::move(parts), report);
    wait_for_the_end();
    jobs.stop();
    worker.stop();
  }
  say("ended\n");
}

}  // namespace

void add_worker_command(CLI::App& program) {
  auto arguments = std::make_shared<FleetArguments>();
  CLI::App* command = add_command(
      program,
      {"worker",
       "work on valves of a fleet: take partitions, estimate, commit",
       "FLEET.toml, which names NATS and PostgreSQL servers (docs/fleet.md), blocks that sites send, and pieces "
       "of work that commands give to the fleet (--fleet)",
       "the fleet's tables; messages go to standard error; any number of workers share valves and pieces",
       {"spoolflow worker fleet.toml"}});
  command->add_option("fleet", arguments->fleet, "fleet file")->type_name("FLEET.toml")->required();
  command->callback([arguments] { worker_command(*arguments); });
  // What a worker starts for each piece; nobody types it.
  auto parent = std::make_shared<pid_t>(0);
  CLI::App* piece = program.add_subcommand("piece", "one piece of batch work, in the present folder")->group("");
  piece->add_option("worker", *parent, "process of the worker")->required();
  piece->callback([parent] {
    fleet::become_piece_process();
    if (::getppid() == *parent) do_piece_here();
  });
}

void add_fleet_command(CLI::App& program) {
  auto arguments = std::make_shared<FleetArguments>();
  CLI::App* command = add_command(
      program,
      {"fleet",
       "show a whole fleet on a page; make its tables and\nstreams; report its state",
       "FLEET.toml, which names NATS and PostgreSQL servers (docs/fleet.md)",
       "a page at http://127.0.0.1:8080 with an interface for other programs, until it is ended; with --setup\n"
       "         tables, stream, roles, and both servers' configuration on standard output; with --status\n"
       "         partitions, their owners, how far behind they are, and pieces of batch work",
       {"spoolflow fleet fleet.toml", "spoolflow fleet --setup fleet.toml", "spoolflow fleet --status fleet.toml"}});
  command->add_option("fleet", arguments->fleet, "fleet file")->type_name("FLEET.toml")->required();
  command
      ->add_option("--listen", arguments->listen,
                   "where the page is, instead of 127.0.0.1:8080 or\nwhat the file says; port 0: any that is free")
      ->type_name("ADDRESS:PORT");
  command->add_flag("--setup", arguments->setup, "make what is missing, print the servers'\nconfiguration");
  command->add_flag("--status", arguments->status, "print partitions, owners and lag");
  command->callback([arguments] { fleet_command(*arguments); });
}

}  // namespace spoolflow::apps
